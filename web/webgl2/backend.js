// A backend for browsers: draws the item buffers of test vectors with WebGL2. docs/backend.md explains the steps.
//
// The vertex stage and the clipping follow the raster rules. All else is left to the device, which snaps and
// interpolates in its own way.
import {areFrontsClockwise, faceTriangles, vertexBytes} from "../device/geometry.js";
import {
  blendOf, channelBits, countsSamples, cullOf, depthFormatOf, depthTestOf, sizeOf, viewportOf, wordsOf
} from "../device/states.js";

const vertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec4 place;     // x, y, z, w with z/w from 0 to 1
layout(location = 1) in vec2 texcoord;
layout(location = 2) in uvec2 value;    // of the triangle; the second word is for pairs
out vec2 unit;
flat out uvec2 flatValue;
void main() {
  // OpenGL has z/w from -1 to 1.
  gl_Position = vec4(place.xy, 2.0 * place.z - place.w, place.w);
  unit = texcoord;
  flatValue = value;
}`;

const fragmentShader = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D indexMap;
uniform bool hasMap, hasBack;
uniform uint back;
uniform int blend;               // 0 clamped add, 1 integer add, 2 replace, 3 none
uniform int cull;                // 0 none, 1 front, 2 back
uniform ivec4 channels;          // bits per channel, least significant first; 0 where there is none
in vec2 unit;
flat in uvec2 flatValue;
layout(location = 0) out uvec2 value;
layout(location = 1) out float passed;  // the blend unit adds it where pixels hold counts

uint ones(int bits) { return bits == 32 ? 0xffffffffu : (1u << uint(bits)) - 1u; }

// Each channel of the sum, at most its largest value.
uint clampedAdd(uint a, uint b) {
  uint sum = 0u;
  int shift = 0;
  for (int k = 0; k < 4 && channels[k] > 0; ++k) {
    uint largest = ones(channels[k]), c = (a >> shift) & largest, d = (b >> shift) & largest;
    sum |= (d > largest - c ? largest : c + d) << shift;
    shift += channels[k];
  }
  return sum;
}

void main() {
  if (cull == (gl_FrontFacing ? 1 : 2)) discard;
  bool isBack = hasBack && !gl_FrontFacing;
  value = isBack ? uvec2(back, 0u) : flatValue;
  passed = 1.0;
  if (hasMap) {
    ivec2 size = textureSize(indexMap, 0);
    ivec2 texel = clamp(ivec2(floor(unit * vec2(size))), ivec2(0), size - 1);
    uint fetched = texelFetch(indexMap, texel, 0).r;
    if (fetched == 0xffffffffu) discard;  // a hole
    if (isBack) return;
    int bits = channels[0] + channels[1] + channels[2] + channels[3];
    if (blend == 0) value.x = clampedAdd(value.x, fetched);
    if (blend == 1) value.x = (value.x + fetched) & ones(bits);
    if (blend == 2) value.x = fetched;
  }
}`;

function shader(gl, type, text) {
  const result = gl.createShader(type);
  gl.shaderSource(result, text);
  gl.compileShader(result);
  if (!gl.getShaderParameter(result, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(result));
  return result;
}

function makeProgram(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl, gl.VERTEX_SHADER, vertexShader));
  gl.attachShader(program, shader(gl, gl.FRAGMENT_SHADER, fragmentShader));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

// Row 0 of the map is row 0 of the texture, at v = 0.
function makeIndexMap(gl, ids, width, height) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32UI, width, height, 0, gl.RED_INTEGER, gl.UNSIGNED_INT, ids);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

// A renderbuffer as an image of the bound framebuffer.
function attach(gl, attachment, format, [columns, rows]) {
  const renderbuffer = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, renderbuffer);
  gl.renderbufferStorage(gl.RENDERBUFFER, format, columns, rows);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, renderbuffer);
  return renderbuffer;
}

// Values of pixels and depths. Blend units add no integers, so that counts are binary32 numbers: exact up to 2^24.
function makeTarget(gl, vector, depthFormat) {
  const framebuffer = gl.createFramebuffer(), size = sizeOf(vector);
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  const format = countsSamples(vector) ? gl.R32F : wordsOf(vector) === 2 ? gl.RG32UI : gl.R32UI;
  const output = gl.COLOR_ATTACHMENT0 + Number(countsSamples(vector));
  const renderbuffers = [attach(gl, output, format, size), attach(gl, gl.DEPTH_ATTACHMENT, depthFormat, size)];
  gl.drawBuffers(countsSamples(vector) ? [gl.NONE, output] : [output]);
  gl.readBuffer(output);
  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE)
    throw new Error(gl.isContextLost() ? "the GPU was reset" : "no target for such values");
  return {framebuffer, renderbuffers};
}

// Copies the triangles of a face to the bound buffer. Returns first vertex and number of vertices of each draw.
function uploadTriangles(gl, vector, face, arrays) {
  const {vertices, runs} = faceTriangles(vector, face, arrays);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STREAM_DRAW);
  return runs;
}

function clearTarget(gl, vector) {
  const background = [vector.background, vector.background, 0, 0];
  if (countsSamples(vector)) gl.clearBufferfv(gl.COLOR, 1, [0, 0, 0, 0]);
  else gl.clearBufferuiv(gl.COLOR, 0, background);
  gl.clearBufferfv(gl.DEPTH, 0, [depthTestOf(vector).cleared]);
}

// The words of a face, row 0 first. Reading one channel is optional in WebGL2, reading four is not.
function readFace(gl, vector, [column, row, width, height]) {
  const pixels = countsSamples(vector) ? new Float32Array(4 * width * height) : new Uint32Array(4 * width * height);
  if (countsSamples(vector)) gl.readPixels(column, row, width, height, gl.RGBA, gl.FLOAT, pixels);
  else gl.readPixels(column, row, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, pixels);
  return Uint32Array.from(pixels.filter((_, k) => k % 4 < wordsOf(vector)));
}

// Draws with the uniforms of `program`; `maps` has a texture per draw, or none.
function drawFace(gl, program, vector, face, arrays, maps) {
  const at = (name) => gl.getUniformLocation(program, name);
  gl.viewport(...viewportOf(vector));
  gl.scissor(...face.scissor);
  clearTarget(gl, vector);
  // Rows count upwards, which reverses windings.
  gl.frontFace(areFrontsClockwise(vector, face) ? gl.CCW : gl.CW);
  const runs = uploadTriangles(gl, vector, face, arrays);
  vector.draws.forEach((draw, k) => {
    gl.uniform1ui(at("back"), draw.back ?? 0);
    gl.uniform1i(at("hasBack"), draw.back == null ? 0 : 1);
    gl.uniform1i(at("hasMap"), maps[k] ? 1 : 0);
    gl.uniform1i(at("cull"), cullOf(draw));
    gl.bindTexture(gl.TEXTURE_2D, maps[k]);
    gl.drawArrays(gl.TRIANGLES, runs[k].first, runs[k].count);
  });
  return readFace(gl, vector, face.scissor);
}

const compareFunctions = {"less": "LESS", "less-equal": "LEQUAL", "greater": "GREATER", "greater-equal": "GEQUAL"};

function drawVector(gl, program, abilities, vector, arrays) {
  const {framebuffer, renderbuffers} = makeTarget(gl, vector, depthFormatOf(vector, abilities));
  gl.depthFunc(gl[compareFunctions[depthTestOf(vector).compare]]);
  if (countsSamples(vector)) gl.enable(gl.BLEND);
  else gl.disable(gl.BLEND);
  gl.uniform4iv(gl.getUniformLocation(program, "channels"), channelBits(vector));
  gl.uniform1i(gl.getUniformLocation(program, "blend"), blendOf(vector));
  const maps = vector.draws.map(
      (draw) => draw.index_map ? makeIndexMap(gl, arrays.maps[draw.index_map], draw.width, draw.height) : null);
  const faces = vector.faces.map((face) => drawFace(gl, program, vector, face, arrays, maps));
  maps.forEach((map) => gl.deleteTexture(map));
  renderbuffers.forEach((renderbuffer) => gl.deleteRenderbuffer(renderbuffer));
  gl.deleteFramebuffer(framebuffer);
  if (gl.getError() !== gl.NO_ERROR) throw new Error("WebGL2 reports an error");
  return faces;
}

// What depthFormatOf asks of a device.
function abilitiesOf(gl) {
  return {
    largestSide: Math.min(gl.getParameter(gl.MAX_RENDERBUFFER_SIZE), ...gl.getParameter(gl.MAX_VIEWPORT_DIMS)),
    depthFormats: {
      exact: gl.DEPTH_COMPONENT32F,
      unorm16: gl.DEPTH_COMPONENT16,
      unorm24: gl.DEPTH_COMPONENT24,
      float32: gl.DEPTH_COMPONENT32F,
    },
    canCount: Boolean(gl.getExtension("EXT_color_buffer_float") && gl.getExtension("EXT_float_blend")),
  };
}

// Chromium tells the device only with the extension, of which Firefox warns.
function deviceName(gl) {
  const name = gl.getParameter(gl.RENDERER);
  const extension = name === "WebKit WebGL" ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  return extension ? gl.getParameter(extension.UNMASKED_RENDERER_WEBGL) : name;
}

// A device with the name of the GPU. `drawVector` takes the object of vector.json and its files as typed arrays:
// positions, texcoords, indices (Uint16Array for 16 bits), vertexValues where the vector has them, and `maps`, by file
// name. It returns the values of the pixels of each face, row 0 first; a pair is two words, the lower one first.
export function openDevice() {
  const gl = document.createElement("canvas").getContext("webgl2", {antialias: false});
  if (!gl) throw new Error("this browser has no WebGL2");
  const program = makeProgram(gl);
  gl.useProgram(program);
  gl.enable(gl.SCISSOR_TEST);
  gl.enable(gl.DEPTH_TEST);
  gl.blendFunc(gl.ONE, gl.ONE);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.vertexAttribPointer(0, 4, gl.FLOAT, false, vertexBytes, 0);
  gl.vertexAttribPointer(1, 2, gl.FLOAT, false, vertexBytes, 16);
  gl.vertexAttribIPointer(2, 2, gl.UNSIGNED_INT, vertexBytes, 24);
  for (const location of [0, 1, 2]) gl.enableVertexAttribArray(location);
  const abilities = abilitiesOf(gl);
  return {
    name: deviceName(gl),
    drawVector: (vector, arrays) => drawVector(gl, program, abilities, vector, arrays),
    close: () => gl.getExtension("WEBGL_lose_context")?.loseContext(),  // a page may hold few contexts
  };
}
