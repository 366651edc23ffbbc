/// The scene as OpenGL is given it: the corners of triangles, one after the other, in vertex buffers.
///
/// Texture coordinates are in texels, since a device rounds u N before it takes the floor: u N is rounded here, once a
/// corner, and down, which changes no floor.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/draw_list.h"

namespace hemitex::reference {

/// A vertex of a triangle, its texture coordinates in texels.
struct TexelCorner {
  glm::vec3 position;
  glm::vec2 texel;
};
using TexelTriangle = std::array<TexelCorner, 3>;

/// The triangles of all draws, one after the other; where a value is not finite, one without any area.
std::vector<TexelTriangle> texelTriangles(const raster::DrawList& list);

/// Makes a vertex buffer, binds it and fills it; `data` may be null for one that is filled later.
void makeVertexBuffer(const void* data, std::size_t bytes, GLenum usage);

/// The offset of a vertex's member in the bound buffer, as OpenGL wants it.
const void* vertexOffset(std::size_t offset);

}  // namespace hemitex::reference
