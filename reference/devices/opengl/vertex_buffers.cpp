#include "reference/devices/opengl/vertex_buffers.h"

#include <array>
#include <cstring>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "reference/devices/opengl/shader_programs.h"

namespace hemitex::reference {
namespace {

struct Vertex {
  glm::vec3 position;
  glm::vec2 texcoord;
  raster::ItemId offset = 0;
};

/// Vertices and the index of each corner, draw after draw.
struct IndexedVertices {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// The bits of a vertex, which have an order even where its numbers are not finite.
using Bits = std::array<std::uint32_t, sizeof(Vertex) / sizeof(std::uint32_t)>;

Bits bitsOf(const Vertex& vertex) {
  Bits bits;
  std::memcpy(bits.data(), &vertex, sizeof(bits));
  return bits;
}

IndexedVertices indexedVertices(const raster::DrawList& list) {
  std::map<Bits, std::uint32_t> known;
  IndexedVertices result;
  for (const raster::Draw& draw : list.draws) {
    const bool isReplaced = draw.indexMap && list.blend == raster::Blend::Replace;
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i) {
      const Vertex vertex{list.positions[list.indices[i]], list.texcoords[list.indices[i]],
                          isReplaced ? 0 : draw.offset};
      const auto number = static_cast<std::uint32_t>(result.vertices.size());
      const auto [place, isNew] = known.try_emplace(bitsOf(vertex), number);
      if (isNew) result.vertices.push_back(vertex);
      result.indices.push_back(place->second);
    }
  }
  return result;
}

void bindAttribute(GLuint location, GLint size, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(Vertex), vertexOffset(offset));
}

void makeBuffer(GLenum target, const void* data, std::size_t bytes, GLenum usage) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, usage);
}

}  // namespace

void makeVertexBuffer(const void* data, std::size_t bytes, GLenum usage) {
  makeBuffer(GL_ARRAY_BUFFER, data, bytes, usage);
}

void uploadVertices(const raster::DrawList& list) {
  const auto [vertices, indices] = indexedVertices(list);
  makeBuffer(GL_ARRAY_BUFFER, vertices.data(), vertices.size() * sizeof(Vertex), GL_STATIC_DRAW);
  bindAttribute(VertexAttribute::position, 3, offsetof(Vertex, position));
  bindAttribute(VertexAttribute::texcoord, 2, offsetof(Vertex, texcoord));
  glEnableVertexAttribArray(VertexAttribute::drawOffset);
  glVertexAttribIPointer(VertexAttribute::drawOffset, 1, GL_UNSIGNED_INT, sizeof(Vertex),
                         vertexOffset(offsetof(Vertex, offset)));
  makeBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size() * sizeof(indices[0]), GL_STATIC_DRAW);
}

const void* vertexOffset(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

void drawRuns(const VertexRuns& runs) {
  glMultiDrawArrays(GL_TRIANGLES, runs.first.data(), runs.count.data(), static_cast<GLsizei>(runs.first.size()));
}

void drawIndexedRuns(const VertexRuns& runs) {
  std::vector<const void*> first;
  for (const int index : runs.first) first.push_back(vertexOffset(static_cast<std::size_t>(index) * sizeof(GLuint)));
  glMultiDrawElements(GL_TRIANGLES, runs.count.data(), GL_UNSIGNED_INT, first.data(),
                      static_cast<GLsizei>(first.size()));
}

}  // namespace hemitex::reference
