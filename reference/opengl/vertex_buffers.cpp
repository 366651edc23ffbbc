#include "reference/opengl/vertex_buffers.h"

namespace hemitex::reference {

void makeVertexBuffer(const void* data, std::size_t bytes, GLenum usage) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
}

const void* vertexOffset(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

void drawRuns(const VertexRuns& runs) {
  glMultiDrawArrays(GL_TRIANGLES, runs.first.data(), runs.count.data(), static_cast<GLsizei>(runs.first.size()));
}

}  // namespace hemitex::reference
