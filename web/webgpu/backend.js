// A backend for browsers: draws the item buffers of test vectors with WebGPU. docs/backend.md explains the steps.
//
// As with WebGL2, the vertex stage and the clipping follow the raster rules, and all else is left to the device.
import {areFrontsClockwise, faceTriangles, vertexBytes} from "../device/geometry.js";
import {
  blendOf, channelBits, countsSamples, cullOf, depthFormatOf, depthTestOf, sizeOf, viewportOf, wordsOf
} from "../device/states.js";

const shaders = /* wgsl */`
struct Draw {
  channels: vec4u,        // bits per channel, least significant first; 0 where there is none
  back: u32,
  hasBack: u32,
  hasMap: u32,
  blend: u32,             // 0 clamped add, 1 integer add, 2 replace, 3 none
  cull: u32,              // 0 none, 1 front, 2 back
}
@group(0) @binding(0) var<uniform> draw: Draw;
@group(0) @binding(1) var indexMap: texture_2d<u32>;

struct Vertex {
  @builtin(position) position: vec4f,
  @location(0) unit: vec2f,
  @location(1) @interpolate(flat) value: vec2u,  // of the triangle; the second word is for pairs
}

@vertex fn vertexStage(@location(0) place: vec4f, @location(1) unit: vec2f, @location(2) value: vec2u) -> Vertex {
  // Row 0 of the picture is y/w = -1, so y is negated.
  return Vertex(vec4f(place.x, -place.y, place.zw), unit, value);
}

fn ones(bits: u32) -> u32 { return select((1u << bits) - 1u, 0xffffffffu, bits == 32u); }

// Each channel of the sum, at most its largest value.
fn clampedAdd(a: u32, b: u32) -> u32 {
  var sum = 0u;
  var shift = 0u;
  for (var k = 0; k < 4 && draw.channels[k] > 0u; k++) {
    let largest = ones(draw.channels[k]);
    let c = (a >> shift) & largest;
    let d = (b >> shift) & largest;
    sum |= select(c + d, largest, d > largest - c) << shift;
    shift += draw.channels[k];
  }
  return sum;
}

fn valueAt(vertex: Vertex, isFront: bool) -> vec2u {
  if (draw.cull == select(2u, 1u, isFront)) { discard; }
  let isBack = draw.hasBack != 0u && !isFront;
  let value = select(vertex.value, vec2u(draw.back, 0u), isBack);
  if (draw.hasMap == 0u) { return value; }
  let size = vec2i(textureDimensions(indexMap));
  let texel = clamp(vec2i(floor(vertex.unit * vec2f(size))), vec2i(0), size - 1);
  let fetched = textureLoad(indexMap, texel, 0).r;
  if (fetched == 0xffffffffu) { discard; }  // a hole
  if (isBack) { return value; }
  let bits = draw.channels.x + draw.channels.y + draw.channels.z + draw.channels.w;
  switch draw.blend {
    case 0: { return vec2u(clampedAdd(value.x, fetched), 0u); }
    case 1: { return vec2u((value.x + fetched) & ones(bits), 0u); }
    case 2: { return vec2u(fetched, 0u); }
    default: { return value; }
  }
}

@fragment fn valueStage(vertex: Vertex, @builtin(front_facing) isFront: bool) -> @location(0) vec2u {
  return valueAt(vertex, isFront);
}

// The blend unit adds these where pixels hold counts.
@fragment fn countStage(vertex: Vertex, @builtin(front_facing) isFront: bool) -> @location(0) f32 {
  let value = valueAt(vertex, isFront);
  return 1.0;
}`;

const drawStride = 256;  // of uniforms: the largest alignment that a device may ask for
const rowAlignment = 256;  // of copies from textures

const vertexLayout = {
  arrayStride: vertexBytes,
  attributes: [
    {shaderLocation: 0, offset: 0, format: "float32x4"},
    {shaderLocation: 1, offset: 16, format: "float32x2"},
    {shaderLocation: 2, offset: 24, format: "uint32x2"},
  ],
};

function makeBindings(device) {
  return device.createBindGroupLayout({
    entries: [
      {
        binding: 0,
        visibility: GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT,
        buffer: {hasDynamicOffset: true, minBindingSize: 48},
      },
      {binding: 1, visibility: GPUShaderStage.FRAGMENT, texture: {sampleType: "uint"}},
    ],
  });
}

// Blend units add no integers, so that counts are binary32 numbers: exact up to 2^24.
const addition = {operation: "add", srcFactor: "one", dstFactor: "one"};
const countTarget = {format: "r32float", blend: {color: addition, alpha: addition}};
const targetOf = (vector) =>
    countsSamples(vector) ? countTarget : {format: wordsOf(vector) === 2 ? "rg32uint" : "r32uint"};

// The pipeline of a vector. The same states give the same one.
function pipelineOf({device, bindings, abilities, pipelines}, vector, face) {
  const format = depthFormatOf(vector, abilities), depthCompare = depthTestOf(vector).compare;
  const target = targetOf(vector), frontFace = areFrontsClockwise(vector, face) ? "cw" : "ccw";
  const states = [format, depthCompare, target.format, frontFace].join();
  if (pipelines.has(states)) return pipelines.get(states);
  const module = device.createShaderModule({code: shaders});
  pipelines.set(states, device.createRenderPipeline({
    layout: device.createPipelineLayout({bindGroupLayouts: [bindings]}),
    vertex: {module, buffers: [vertexLayout]},
    fragment: {module, entryPoint: countsSamples(vector) ? "countStage" : "valueStage", targets: [target]},
    primitive: {topology: "triangle-list", cullMode: "none", frontFace},
    depthStencil: {format, depthWriteEnabled: true, depthCompare},
  }));
  return pipelines.get(states);
}

// Row 0 of the map is row 0 of the texture, at v = 0.
function makeIndexMap(device, ids, width, height) {
  const texture = device.createTexture(
      {size: [width, height], format: "r32uint", usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST});
  device.queue.writeTexture({texture}, ids, {bytesPerRow: 4 * width}, [width, height]);
  return texture;
}

function makeBuffer(device, usage, data) {
  const buffer = device.createBuffer({size: Math.max(data.byteLength, 4), usage: usage | GPUBufferUsage.COPY_DST});
  device.queue.writeBuffer(buffer, 0, data);
  return buffer;
}

// The uniforms of all draws, one stride each.
function drawUniforms(vector) {
  const bytes = new ArrayBuffer(drawStride * vector.draws.length);
  vector.draws.forEach((draw, k) => {
    const {back, index_map: map} = draw, states = [map ? 1 : 0, blendOf(vector), cullOf(draw)];
    const uniforms = [...channelBits(vector), back ?? 0, back == null ? 0 : 1, ...states];
    new Uint32Array(bytes, drawStride * k, uniforms.length).set(uniforms);
  });
  return new Uint8Array(bytes);
}

// Records the draws of a face, and a copy of its scissor rectangle to a new buffer, which is returned.
function recordFace(gpu, scene, encoder, vector, face, arrays) {
  const {device} = gpu, cleared = countsSamples(vector) ? 0 : vector.background;
  const {vertices, runs} = faceTriangles(vector, face, arrays);
  const pass = encoder.beginRenderPass({
    colorAttachments: [{
      view: scene.values.createView(),
      clearValue: {r: cleared, g: cleared, b: 0, a: 0},
      loadOp: "clear",
      storeOp: "store",
    }],
    depthStencilAttachment: {
      view: scene.depths.createView(),
      depthClearValue: depthTestOf(vector).cleared,
      depthLoadOp: "clear",
      depthStoreOp: "discard",
    },
  });
  const [column, row, width, height] = face.scissor;
  pass.setPipeline(pipelineOf(gpu, vector, face));
  pass.setViewport(...viewportOf(vector), 0, 1);
  pass.setScissorRect(column, row, width, height);
  pass.setVertexBuffer(0, scene.keep(makeBuffer(device, GPUBufferUsage.VERTEX, vertices)));
  runs.forEach(({first, count}, k) => {
    if (count === 0) return;  // browsers warn of it
    pass.setBindGroup(0, scene.groups[k], [drawStride * k]);
    pass.draw(count, 1, first);
  });
  pass.end();
  const bytesPerRow = Math.ceil(4 * wordsOf(vector) * width / rowAlignment) * rowAlignment;
  const buffer = scene.keep(device.createBuffer(
      {size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ}));
  encoder.copyTextureToBuffer({texture: scene.values, origin: [column, row]}, {buffer, bytesPerRow}, [width, height]);
  return {buffer, bytesPerRow, width: wordsOf(vector) * width, height, areCounts: countsSamples(vector)};
}

// The words in a buffer, without the padding of rows.
async function readWords({buffer, bytesPerRow, width, height, areCounts}) {
  await buffer.mapAsync(GPUMapMode.READ);
  const bytes = buffer.getMappedRange(), words = new Uint32Array(width * height);
  const padded = areCounts ? new Float32Array(bytes) : new Uint32Array(bytes);
  for (let row = 0; row < height; ++row)
    words.set(padded.subarray(row * bytesPerRow / 4, row * bytesPerRow / 4 + width), row * width);
  buffer.unmap();
  return words;
}

// Images, buffers and bindings of a vector. `kept` is destroyed after the last face is read.
function uploadScene({device, bindings, abilities}, vector, arrays) {
  const kept = [], keep = (object) => (kept.push(object), object);
  const target = (format, usage) => keep(device.createTexture({size: sizeOf(vector), format, usage}));
  const depths = target(depthFormatOf(vector, abilities), GPUTextureUsage.RENDER_ATTACHMENT);
  const uniforms = keep(makeBuffer(device, GPUBufferUsage.UNIFORM, drawUniforms(vector)));
  const groups = vector.draws.map((draw) => {
    const map = draw.index_map ? makeIndexMap(device, arrays.maps[draw.index_map], draw.width, draw.height) :
                                 makeIndexMap(device, new Uint32Array(1), 1, 1);
    return device.createBindGroup({
      layout: bindings,
      entries: [
        {binding: 0, resource: {buffer: uniforms, size: 48}},
        {binding: 1, resource: keep(map).createView()},
      ],
    });
  });
  return {
    kept, keep, groups, depths,
    values: target(targetOf(vector).format, GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC),
  };
}

async function drawVector(gpu, vector, arrays) {
  const {device} = gpu;
  device.pushErrorScope("validation");
  const scene = uploadScene(gpu, vector, arrays), encoder = device.createCommandEncoder();
  const copies = vector.faces.map((face) => recordFace(gpu, scene, encoder, vector, face, arrays));
  device.queue.submit([encoder.finish()]);
  const error = await device.popErrorScope();
  if (error) throw new Error(error.message);
  const faces = await Promise.all(copies.map(readWords));
  for (const object of scene.kept) object.destroy();
  return faces;
}

function deviceName({vendor, architecture, device, description}) {
  return description || [vendor, architecture, device].filter((text) => text).join(" ") || "a GPU without a name";
}

// A device with the name of the GPU. `drawVector` takes and returns what that of WebGL2 does, as a promise.
export async function openDevice() {
  if (!navigator.gpu) throw new Error("this browser has no WebGPU");
  const adapter = await navigator.gpu.requestAdapter();
  if (!adapter) throw new Error("the WebGPU of this browser finds no GPU");
  const side = "maxTextureDimension2D", canCount = adapter.features.has("float32-blendable");
  const device = await adapter.requestDevice({
    requiredFeatures: canCount ? ["float32-blendable"] : [],
    requiredLimits: {[side]: adapter.limits[side]},
  });
  // A "depth24plus" may have 32 bits.
  const depthFormats = {exact: "depth32float", unorm16: "depth16unorm", float32: "depth32float"};
  const abilities = {largestSide: device.limits[side], depthFormats, canCount};
  const gpu = {device, bindings: makeBindings(device), abilities, pipelines: new Map()};
  return {
    name: deviceName(adapter.info),
    drawVector: (vector, arrays) => drawVector(gpu, vector, arrays),
    close: () => device.destroy(),
  };
}
