#include "reference/devices/opengl/shader_programs.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

// CMake puts the texts of the shaders here.
#include <item_ids_text.h>

namespace hemitex::reference {
namespace {

// Back-facing triangles and the clamped add (docs/item-buffers.md, "blend").
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
  return linkProgram({{GL_VERTEX_SHADER, {itemIdsVertexText}}, {GL_FRAGMENT_SHADER, {itemIdsFragmentText}}});
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

}  // namespace hemitex::reference
