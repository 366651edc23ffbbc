#include "reference/devices/opengl/pipeline.h"

#include <array>

#include "raster/base/input_error.h"

namespace hemitex::reference {

void useProgram(const std::string& vertexText, const std::string& fragmentText) {
  const GLuint program = glCreateProgram();
  const auto attach = [program](GLenum stage, const char* text) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
  };
  attach(GL_VERTEX_SHADER, vertexText.c_str());
  attach(GL_FRAGMENT_SHADER, fragmentText.c_str());
  glLinkProgram(program);
  GLint isLinked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &isLinked);
  if (isLinked) return glUseProgram(program);
  std::array<GLchar, 4096> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw raster::InputError(std::string("the OpenGL device refuses the programs: ") + log.data());
}

GLuint makeBuffer(std::span<const std::byte> content) {
  GLuint buffer = 0;
  glCreateBuffers(1, &buffer);
  glNamedBufferData(buffer, static_cast<GLsizeiptr>(content.size()), content.data(), GL_STATIC_DRAW);
  return buffer;
}

void drawRuns(const VertexRuns& runs) {
  glMultiDrawArrays(GL_TRIANGLES, runs.first.data(), runs.count.data(), static_cast<GLsizei>(runs.first.size()));
}

}  // namespace hemitex::reference
