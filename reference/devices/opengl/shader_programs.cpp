#include "reference/devices/opengl/shader_programs.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

// docs/item-buffers.md, "view": in binary32, and `precise`, so that nothing is fused or reordered.
constexpr const char* vertexProgram = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texcoord;
layout(location = 2) in uint drawOffset;
layout(location = 0) uniform vec3 eye;
layout(location = 1) uniform mat3 columns;  // of the matrix with the rows X, Y, W
out vec3 view;
out vec2 uv;
out uint vertexOffset;

void main() {
  precise vec3 d = position - eye;
  precise vec3 sum = (columns[0] * d.x + columns[1] * d.y) + columns[2] * d.z;
  view = sum;
  uv = texcoord;
  vertexOffset = drawOffset;
}
)";

// Depth and coordinates as planes (Olano and Greer 1997). Let v_k be the corners of a triangle. Its point seen at p =
// (x/w, y/w, 1) is w p = sum(b_k v_k). Let c_k be the cross product of the two other corners and D = v_0 . c_0. Then
// b_k = w (c_k . p) / D, and since the b_k sum to one,
//
//   1/w = (sum(c_k) . p) / D,    s = sum(b_k s_k) = (sum(s_k c_k) . p) / (sum(c_k) . p).
//
// So three vectors are enough. Lengths across are in sub-pixels. Corners are snapped after the near plane has clipped
// the triangle, as in the rules: perspective would magnify the move of a corner at the near plane.
constexpr const char* geometryProgram = R"(#version 450
layout(triangles) in;
layout(triangle_strip, max_vertices = 6) out;
layout(location = 2) uniform float near;
layout(location = 3) uniform double unit;  // sub-pixels a unit of x/w
layout(location = 4) uniform double width;
layout(binding = 0) uniform usampler2DRect map;
in vec3 view[];
in vec2 uv[];
in uint vertexOffset[];
flat out dvec3 one, s, t;
flat out double volume;
flat out uint offset;

struct Vertex {
  dvec3 view;   // x, y, w
  dvec2 texel;  // u N and v M, which are exact in double precision
};

// Where the edge from a vertex in front of the near plane to one behind it crosses the plane.
Vertex crossing(Vertex inside, Vertex outside) {
  precise double part = (inside.view.z - near) / (inside.view.z - outside.view.z);
  precise dvec3 at = inside.view + part * (outside.view - inside.view);
  precise dvec2 texel = inside.texel + part * (outside.texel - inside.texel);
  return Vertex(dvec3(at.xy, near), texel);
}

int clip(Vertex corners[3], out Vertex polygon[4]) {
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    Vertex from = corners[k], to = corners[(k + 1) % 3];
    bool fromInside = from.view.z >= near, toInside = to.view.z >= near;
    if (fromInside) polygon[count++] = from;
    if (fromInside && !toInside) polygon[count++] = crossing(from, to);
    if (!fromInside && toInside) polygon[count++] = crossing(to, from);
  }
  return count;
}

dvec3 snapped(dvec3 v) { return dvec3((roundEven((v.xy / v.z + 1) * unit) - unit) * v.z, v.z); }

void emitTriangle(Vertex a, Vertex b, Vertex d) {
  dvec3 v[3] = dvec3[3](snapped(a.view), snapped(b.view), snapped(d.view));
  dvec3 c[3] = dvec3[3](cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1]));
  for (int k = 0; k < 3; ++k) {
    one = c[0] + c[1] + c[2];
    s = c[0] * a.texel.x + c[1] * b.texel.x + c[2] * d.texel.x;
    t = c[0] * a.texel.y + c[1] * b.texel.y + c[2] * d.texel.y;
    volume = dot(v[0], c[0]);
    offset = vertexOffset[0];
    gl_Position = vec4(v[k].xy / (unit * width), near, v[k].z);
    EmitVertex();
  }
  EndPrimitive();
}

void main() {
  Vertex corners[3], polygon[4];
  for (int k = 0; k < 3; ++k) {
    if (any(isnan(view[k])) || any(isinf(view[k])) || any(isnan(uv[k])) || any(isinf(uv[k]))) return;
    corners[k] = Vertex(view[k], dvec2(uv[k]) * dvec2(textureSize(map)));
  }
  int count = clip(corners, polygon);
  for (int k = 2; k < count; ++k) emitTriangle(polygon[0], polygon[k - 1], polygon[k]);
}
)";

// Back-facing triangles and the clamped add of both paths (docs/item-buffers.md, "blend").
constexpr const char* channelProgram = R"(#version 450
layout(location = 7) uniform uint back;
layout(location = 8) uniform bool hasBack;
layout(location = 10) uniform uint allBits;
layout(location = 11) uniform int channels;
layout(location = 12) uniform uint channel[32];  // the bits of each

uint clampedAdd(uint a, uint b) {
  uint sum = 0u;
  for (int c = 0; c < channels; ++c) {
    uint x = a & channel[c], y = b & channel[c];
    sum |= y + min(x, channel[c] - y);
  }
  return sum;
}
)";

// All blends.
constexpr const char* blendProgram = R"(
layout(location = 9) uniform int operation;  // 0: no index map, 1: clamped add, 2: integer add, 3: replace

uint blended(uint offset, uint texel) {
  if (operation == 1) return clampedAdd(offset, texel);
  if (operation == 2) return (offset + texel) & allBits;
  return texel;
}
)";

// The depth is w itself, scaled below 1 by a power of two. It is often a binary32 number where 1/w is not.
constexpr const char* fragmentProgram = R"(
layout(location = 3) uniform double unit;
layout(location = 5) uniform vec2 corner;  // of the scissor rectangle
layout(binding = 0) uniform usampler2DRect map;
flat in dvec3 one, s, t;
flat in double volume;
flat in uint offset;
out uint word;

void main() {
  dvec3 p = dvec3(256 * (gl_FragCoord.xy + corner) - unit, 1);
  gl_FragDepth = float(volume / dot(one, p)) * 5.421010862427522e-20;  // 2^-64
  word = offset;
  if (hasBack && !gl_FrontFacing) {
    word = back;
  } else if (operation != 0) {
    dvec2 position = dvec2(dot(s, p), dot(t, p)) / dot(one, p);
    uint texel = texelFetch(map, ivec2(clamp(floor(position), dvec2(0), dvec2(textureSize(map) - 1)))).x;
    word = blended(offset, texel);
  }
}
)";

constexpr const char* plainVertexProgram = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texcoord;
layout(location = 2) in uint drawOffset;
layout(location = 0) uniform mat4 matrix;
out vec2 uv;
flat out uint offset;

void main() {
  gl_Position = matrix * vec4(position, 1);
  uv = texcoord;
  offset = drawOffset;
}
)";

constexpr const char* integerSumProgram = R"(
uint sum(uint offset, uint texel) { return (offset + texel) & allBits; }
)";

constexpr const char* clampedSumProgram = R"(
uint sum(uint offset, uint texel) { return clampedAdd(offset, texel); }
)";

constexpr const char* plainFragmentProgram = R"(
layout(binding = 0) uniform usampler2D map;
in vec2 uv;
flat in uint offset;
out uint word;

void main() { word = hasBack && !gl_FrontFacing ? back : sum(offset, texture(map, uv).x); }
)";

using Texts = std::vector<const char*>;

void attachShader(GLuint program, GLenum stage, const Texts& texts) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
}

GLuint linkProgram(const std::vector<std::pair<GLenum, Texts>>& shaders) {
  const GLuint program = glCreateProgram();
  for (const auto& [stage, texts] : shaders) attachShader(program, stage, texts);
  glLinkProgram(program);
  GLint isLinked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &isLinked);
  if (isLinked) return program;
  std::array<GLchar, 4096> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw raster::InputError(std::string("the OpenGL device refuses the programs: ") + log.data());
}

}  // namespace

GLuint linkShaderPrograms() {
  return linkProgram({{GL_VERTEX_SHADER, {vertexProgram}},
                      {GL_GEOMETRY_SHADER, {geometryProgram}},
                      {GL_FRAGMENT_SHADER, {channelProgram, blendProgram, fragmentProgram}}});
}

GLuint linkPlainPrograms(bool clamps) {
  return linkProgram(
      {{GL_VERTEX_SHADER, {plainVertexProgram}},
       {GL_FRAGMENT_SHADER, {channelProgram, clamps ? clampedSumProgram : integerSumProgram, plainFragmentProgram}}});
}

void setFormat(const raster::IdFormat& format) {
  glUniform1ui(Uniform::allBits, raster::backgroundId(format));
  std::vector<GLuint> channels;
  int shift = 0;
  for (const int bits : format.channelBits) {
    channels.push_back(raster::backgroundId({{bits}}) << shift);
    shift += bits;
  }
  glUniform1i(Uniform::channels, static_cast<GLint>(channels.size()));
  glUniform1uiv(Uniform::channel, static_cast<GLsizei>(channels.size()), channels.data());
}

void setBack(const raster::Draw& draw) {
  glUniform1ui(Uniform::back, draw.back.value_or(0));
  glUniform1i(Uniform::hasBack, draw.back.has_value());
}

void setOperation(const raster::Draw& draw, raster::Blend blend) {
  glUniform1i(Uniform::operation, draw.indexMap ? 1 + static_cast<GLint>(blend) : 0);
}

}  // namespace hemitex::reference
