// A backend for browsers: draws the item buffers of test vectors with WebGPU. docs/backend.md explains the steps.
//
// As with WebGL2, the vertex stage and the clipping follow the raster rules, and all else is left to the device.
import {
  blends, channelBits, cullOf, faceTriangles, isMirrored, requireDrawable, vertexBytes
} from "../device/geometry.js";

const shaders = /* wgsl */`
struct Draw {
  channels: vec4u,        // bits per channel, least significant first; 0 where there is none
  nearDistance: f32,
  offset: u32,
  back: u32,
  hasBack: u32,
  hasMap: u32,
  blend: u32,             // 0 clamped add, 1 integer add, 2 replace
  cull: u32,              // 0 none, 1 front, 2 back
}
@group(0) @binding(0) var<uniform> draw: Draw;
@group(0) @binding(1) var indexMap: texture_2d<u32>;

struct Vertex {
  @builtin(position) position: vec4f,
  @location(0) unit: vec2f,
}

@vertex fn vertexStage(@location(0) view: vec3f, @location(1) unit: vec2f) -> Vertex {
  // Row 0 of the picture is y/w = -1, so y is negated. The stored depth is n/w: greater is nearer.
  return Vertex(vec4f(view.x, -view.y, draw.nearDistance, view.z), unit);
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

@fragment fn fragmentStage(@location(0) unit: vec2f, @builtin(front_facing) isFront: bool) -> @location(0) u32 {
  if (draw.cull == select(2u, 1u, isFront)) { discard; }
  let isBack = draw.hasBack != 0u && !isFront;
  if (draw.hasMap == 0u) { return select(draw.offset, draw.back, isBack); }
  let size = vec2i(textureDimensions(indexMap));
  let texel = clamp(vec2i(floor(unit * vec2f(size))), vec2i(0), size - 1);
  let fetched = textureLoad(indexMap, texel, 0).r;
  if (fetched == 0xffffffffu) { discard; }  // a hole
  if (isBack) { return draw.back; }
  let bits = draw.channels.x + draw.channels.y + draw.channels.z + draw.channels.w;
  switch draw.blend {
    case 0: { return clampedAdd(draw.offset, fetched); }
    case 1: { return (draw.offset + fetched) & ones(bits); }
    default: { return fetched; }
  }
}`;

const drawStride = 256;  // of uniforms: the largest alignment that a device may ask for
const rowAlignment = 256;  // of copies from textures

const vertexLayout = {
  arrayStride: vertexBytes,
  attributes: [
    {shaderLocation: 0, offset: 0, format: "float32x3"},
    {shaderLocation: 1, offset: 12, format: "float32x2"},
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

function makePipeline(device, bindings, frontFace) {
  const module = device.createShaderModule({code: shaders});
  return device.createRenderPipeline({
    layout: device.createPipelineLayout({bindGroupLayouts: [bindings]}),
    vertex: {module, buffers: [vertexLayout]},
    fragment: {module, targets: [{format: "r32uint"}]},
    primitive: {topology: "triangle-list", cullMode: "none", frontFace},
    depthStencil: {format: "depth32float", depthWriteEnabled: true, depthCompare: "greater"},
  });
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
    new Float32Array(bytes, drawStride * k + 16, 1)[0] = vector.near;
    const {offset, back, index_map: map} = draw, uniforms = new Uint32Array(bytes, drawStride * k, 12);
    uniforms.set(channelBits(vector));
    const blend = blends.indexOf(vector.blend);
    uniforms.set([offset, back ?? 0, back == null ? 0 : 1, map ? 1 : 0, blend, cullOf(draw)], 5);
  });
  return new Uint8Array(bytes);
}

// Records the draws of a face, and a copy of its scissor rectangle to a new buffer, which is returned.
function recordFace(gpu, scene, encoder, vector, face, arrays) {
  const {device, pipelines} = gpu;
  const {vertices, runs} = faceTriangles(vector, face, arrays);
  const pass = encoder.beginRenderPass({
    colorAttachments: [{
      view: scene.ids.createView(),
      clearValue: {r: vector.background, g: 0, b: 0, a: 0},
      loadOp: "clear",
      storeOp: "store",
    }],
    depthStencilAttachment:
        {view: scene.depths.createView(), depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "discard"},
  });
  const [column, row, width, height] = face.scissor;
  pass.setPipeline(isMirrored(face) ? pipelines.mirrored : pipelines.usual);
  pass.setScissorRect(column, row, width, height);
  pass.setVertexBuffer(0, scene.keep(makeBuffer(device, GPUBufferUsage.VERTEX, vertices)));
  runs.forEach(({first, count}, k) => {
    if (count === 0) return;  // browsers warn of it
    pass.setBindGroup(0, scene.groups[k], [drawStride * k]);
    pass.draw(count, 1, first);
  });
  pass.end();
  const bytesPerRow = Math.ceil(4 * width / rowAlignment) * rowAlignment;
  const buffer = scene.keep(device.createBuffer(
      {size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ}));
  encoder.copyTextureToBuffer({texture: scene.ids, origin: [column, row]}, {buffer, bytesPerRow}, [width, height]);
  return {buffer, bytesPerRow, width, height};
}

// The item IDs in a buffer, without the padding of rows.
async function readIds({buffer, bytesPerRow, width, height}) {
  await buffer.mapAsync(GPUMapMode.READ);
  const padded = new Uint32Array(buffer.getMappedRange()), ids = new Uint32Array(width * height);
  for (let row = 0; row < height; ++row)
    ids.set(padded.subarray(row * bytesPerRow / 4, row * bytesPerRow / 4 + width), row * width);
  buffer.unmap();
  return ids;
}

// Images, buffers and bindings of a vector. `kept` is destroyed after the last face is read.
function uploadScene({device, bindings}, vector, arrays) {
  const kept = [], keep = (object) => (kept.push(object), object);
  const target = (format, usage) => keep(
      device.createTexture({size: [vector.resolution, vector.resolution], format, usage}));
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
    kept, keep, groups,
    ids: target("r32uint", GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC),
    depths: target("depth32float", GPUTextureUsage.RENDER_ATTACHMENT),
  };
}

async function drawVector(gpu, vector, arrays) {
  requireDrawable(vector);
  const {device} = gpu;
  device.pushErrorScope("validation");
  const scene = uploadScene(gpu, vector, arrays), encoder = device.createCommandEncoder();
  const copies = vector.faces.map((face) => recordFace(gpu, scene, encoder, vector, face, arrays));
  device.queue.submit([encoder.finish()]);
  const error = await device.popErrorScope();
  if (error) throw new Error(error.message);
  const faces = await Promise.all(copies.map(readIds));
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
  const device = await adapter.requestDevice(), bindings = makeBindings(device);
  // Negated y reverses windings: a view that is not mirrored shows fronts counter-clockwise.
  const gpu = {device, bindings, pipelines: {
    usual: makePipeline(device, bindings, "ccw"),
    mirrored: makePipeline(device, bindings, "cw"),
  }};
  return {
    name: deviceName(adapter.info),
    drawVector: (vector, arrays) => drawVector(gpu, vector, arrays),
    close: () => device.destroy(),
  };
}
