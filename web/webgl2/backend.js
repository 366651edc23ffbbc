// A backend for browsers: draws the item buffers of test vectors with WebGL2. docs/backend.md explains the steps.
//
// The vertex stage and the clipping follow the raster rules. All else is left to the device, which snaps and
// interpolates in its own way.
import {
  blends, channelBits, cullOf, faceTriangles, isMirrored, requireDrawable, vertexBytes
} from "../device/geometry.js";

const vertexShader = `#version 300 es
precision highp float;
uniform float nearDistance;
layout(location = 0) in vec3 view;      // x, y, w
layout(location = 1) in vec2 texcoord;
out vec2 unit;
void main() {
  // z/w = 2 n/w - 1, so that the stored depth is n/w: greater is nearer.
  gl_Position = vec4(view.xy, 2.0 * nearDistance - view.z, view.z);
  unit = texcoord;
}`;

const fragmentShader = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D indexMap;
uniform bool hasMap, hasBack;
uniform uint offset, back;
uniform int blend;               // 0 clamped add, 1 integer add, 2 replace
uniform int cull;                // 0 none, 1 front, 2 back
uniform ivec4 channels;          // bits per channel, least significant first; 0 where there is none
in vec2 unit;
out uint id;

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
  id = isBack ? back : offset;
  if (hasMap) {
    ivec2 size = textureSize(indexMap, 0);
    ivec2 texel = clamp(ivec2(floor(unit * vec2(size))), ivec2(0), size - 1);
    uint fetched = texelFetch(indexMap, texel, 0).r;
    if (fetched == 0xffffffffu) discard;  // a hole
    if (isBack) return;
    int bits = channels[0] + channels[1] + channels[2] + channels[3];
    if (blend == 0) id = clampedAdd(offset, fetched);
    if (blend == 1) id = (offset + fetched) & ones(bits);
    if (blend == 2) id = fetched;
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

// Item IDs and depths of the size `resolution`.
function makeTarget(gl, resolution) {
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  const images = [[gl.COLOR_ATTACHMENT0, gl.R32UI], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT32F]];
  const renderbuffers = images.map(([attachment, format]) => {
    const renderbuffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, renderbuffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, format, resolution, resolution);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, renderbuffer);
    return renderbuffer;
  });
  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE)
    throw new Error(gl.isContextLost() ? "the GPU was reset" : "no integer target");
  return {framebuffer, renderbuffers};
}

// Copies the triangles of a face to the bound buffer. Returns first vertex and number of vertices of each draw.
function uploadTriangles(gl, vector, face, arrays) {
  const {vertices, runs} = faceTriangles(vector, face, arrays);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STREAM_DRAW);
  return runs;
}

// Draws with the uniforms of `program`; `maps` has a texture per draw, or none.
function drawFace(gl, program, vector, face, arrays, maps) {
  const at = (name) => gl.getUniformLocation(program, name);
  const [column, row, width, height] = face.scissor;
  gl.viewport(0, 0, vector.resolution, vector.resolution);
  gl.scissor(column, row, width, height);
  gl.clearBufferuiv(gl.COLOR, 0, [vector.background, 0, 0, 0]);
  gl.clearBufferfv(gl.DEPTH, 0, [0]);
  gl.frontFace(isMirrored(face) ? gl.CCW : gl.CW);
  gl.uniform1f(at("nearDistance"), vector.near);
  const runs = uploadTriangles(gl, vector, face, arrays);
  vector.draws.forEach((draw, k) => {
    gl.uniform1ui(at("offset"), draw.offset);
    gl.uniform1ui(at("back"), draw.back ?? 0);
    gl.uniform1i(at("hasBack"), draw.back == null ? 0 : 1);
    gl.uniform1i(at("hasMap"), maps[k] ? 1 : 0);
    gl.uniform1i(at("cull"), cullOf(draw));
    gl.bindTexture(gl.TEXTURE_2D, maps[k]);
    gl.drawArrays(gl.TRIANGLES, runs[k].first, runs[k].count);
  });
  // Reading one channel is optional in WebGL2, reading four is not.
  const pixels = new Uint32Array(4 * width * height);
  gl.readPixels(column, row, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, pixels);
  return pixels.filter((_, k) => k % 4 === 0);
}

function drawVector(gl, program, vector, arrays) {
  requireDrawable(vector);
  const {framebuffer, renderbuffers} = makeTarget(gl, vector.resolution);
  gl.uniform4iv(gl.getUniformLocation(program, "channels"), channelBits(vector));
  gl.uniform1i(gl.getUniformLocation(program, "blend"), blends.indexOf(vector.blend));
  const maps = vector.draws.map(
      (draw) => draw.index_map ? makeIndexMap(gl, arrays.maps[draw.index_map], draw.width, draw.height) : null);
  const faces = vector.faces.map((face) => drawFace(gl, program, vector, face, arrays, maps));
  maps.forEach((map) => gl.deleteTexture(map));
  renderbuffers.forEach((renderbuffer) => gl.deleteRenderbuffer(renderbuffer));
  gl.deleteFramebuffer(framebuffer);
  if (gl.getError() !== gl.NO_ERROR) throw new Error("WebGL2 reports an error");
  return faces;
}

// Chromium tells the device only with the extension, of which Firefox warns.
function deviceName(gl) {
  const name = gl.getParameter(gl.RENDERER);
  const extension = name === "WebKit WebGL" ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  return extension ? gl.getParameter(extension.UNMASKED_RENDERER_WEBGL) : name;
}

// A device with the name of the GPU. `drawVector` takes the object of vector.json and its files as typed arrays:
// positions, texcoords, indices, and `maps`, by file name. It returns the item IDs of each face, row 0 first.
export function openDevice() {
  const gl = document.createElement("canvas").getContext("webgl2", {antialias: false});
  if (!gl) throw new Error("this browser has no WebGL2");
  const program = makeProgram(gl);
  gl.useProgram(program);
  gl.enable(gl.SCISSOR_TEST);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.GREATER);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, vertexBytes, 0);
  gl.vertexAttribPointer(1, 2, gl.FLOAT, false, vertexBytes, 12);
  gl.enableVertexAttribArray(0);
  gl.enableVertexAttribArray(1);
  return {
    name: deviceName(gl),
    drawVector: (vector, arrays) => drawVector(gl, program, vector, arrays),
    close: () => gl.getExtension("WEBGL_lose_context")?.loseContext(),  // a page may hold few contexts
  };
}
