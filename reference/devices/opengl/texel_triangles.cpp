#include "reference/devices/opengl/texel_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/setup/vertex_stage.h"

namespace hemitex::reference {
namespace {

/// u N, rounded down to binary32, which changes no floor.
float texelPosition(float u, int size) {
  constexpr float largest = std::numeric_limits<float>::max();
  const double exact = std::clamp<double>(static_cast<double>(u) * size, -largest, largest);
  const float nearest = static_cast<float>(exact);
  return static_cast<double>(nearest) > exact ? std::nextafter(nearest, -largest) : nearest;
}

/// The triangle whose indices begin at `first`; `map` is null if the draw has none.
TexelTriangle triangleAt(const raster::DrawList& list, std::uint32_t first, const raster::IndexMap* map) {
  TexelTriangle triangle;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const glm::vec3& position = list.positions[list.indices[first + k]];
    const glm::vec2& texcoord = list.texcoords[list.indices[first + k]];
    if (!raster::isFinite({position.x, position.y, position.z, texcoord.x, texcoord.y})) return {};
    triangle[k].position = position;
    if (map) triangle[k].texel = {texelPosition(texcoord.x, map->width), texelPosition(texcoord.y, map->height)};
  }
  return triangle;
}

}  // namespace

std::vector<TexelTriangle> texelTriangles(const raster::DrawList& list) {
  std::vector<TexelTriangle> triangles;
  for (const raster::Draw& draw : list.draws) {
    const raster::IndexMap* map = draw.indexMap ? &list.indexMaps[static_cast<std::size_t>(*draw.indexMap)] : nullptr;
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3)
      triangles.push_back(triangleAt(list, first, map));
  }
  return triangles;
}

}  // namespace hemitex::reference
