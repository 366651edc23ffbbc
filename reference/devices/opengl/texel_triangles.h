/// The scene as OpenGL draws it: the corners of triangles, one after the other.
///
/// Texture coordinates are in texels, because devices round u N before the floor function. Here u N is rounded down,
/// once per corner, which changes no floor.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/draw_list.h"

namespace hemitex::reference {

/// A vertex of a triangle, with texture coordinates in texels.
struct TexelCorner {
  glm::vec3 position;
  glm::vec2 texel;
};
using TexelTriangle = std::array<TexelCorner, 3>;

/// The triangles of all draws, one after the other. A triangle with a value that is not finite is replaced by one
/// without area.
std::vector<TexelTriangle> texelTriangles(const raster::DrawList& list);

}  // namespace hemitex::reference
