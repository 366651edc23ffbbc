#include "reference/opengl/vertex_buffers.h"

#include <glm/glm.hpp>
#include <vector>

namespace hemitex::reference {
namespace {

struct Corner {
  glm::vec3 position;
  glm::vec2 texcoord;
};

}  // namespace

void makeVertexBuffer(const void* data, std::size_t bytes, GLenum usage) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
}

void uploadCorners(const raster::DrawList& list, GLuint position, GLuint texcoord) {
  std::vector<Corner> corners;
  for (const raster::Draw& draw : list.draws)
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i)
      corners.push_back({list.positions[list.indices[i]], list.texcoords[list.indices[i]]});
  makeVertexBuffer(corners.data(), corners.size() * sizeof(Corner), GL_STATIC_DRAW);
  glEnableVertexAttribArray(position);
  glEnableVertexAttribArray(texcoord);
  glVertexAttribPointer(position, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), vertexOffset(offsetof(Corner, position)));
  glVertexAttribPointer(texcoord, 2, GL_FLOAT, GL_FALSE, sizeof(Corner), vertexOffset(offsetof(Corner, texcoord)));
}

const void* vertexOffset(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

void drawRuns(const VertexRuns& runs) {
  glMultiDrawArrays(GL_TRIANGLES, runs.first.data(), runs.count.data(), static_cast<GLsizei>(runs.first.size()));
}

}  // namespace hemitex::reference
