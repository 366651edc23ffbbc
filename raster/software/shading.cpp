#include "raster/software/shading.h"

#include <cstddef>

#include "raster/setup/exact_interpolation.h"

namespace hemitex::raster {

Shading shadingOf(const PreparedDrawList& draws, const ScreenTriangle& triangle) {
  const DrawList& list = draws.list;
  const Draw& draw = list.draws[triangle.draw];
  if (triangle.facesAway && draw.back) return {*draw.back, {}};
  if (!draw.indexMap) return {draw.offset, {}};
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const PreparedDrawList::MapTraits& traits = draws.maps[static_cast<std::size_t>(*draw.indexMap)];
  const bool isSum = list.blend != Blend::Replace && (draw.offset & traits.bits) == 0;
  return {draw.offset,
          Shading::Texels{&map, isSum, isSum && traits.countsTexels, TexelPlanes(triangle, map.width, map.height), {}}};
}

ItemId idOf(const PreparedDrawList& draws, const Draw& draw, bool facesAway, ItemId texel) {
  if (facesAway && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const auto map = static_cast<std::size_t>(*draw.indexMap);
  const PreparedDrawList::MapTraits& traits = draws.maps[map];
  const bool isSum = draws.list.blend != Blend::Replace && (draw.offset & traits.bits) == 0;
  if (isSum && traits.countsTexels) return draw.offset + texel;
  const ItemId id = draws.list.indexMaps[map].ids[texel];
  return isSum ? draw.offset | id : blend(draws.list.format, draws.list.blend, draw.offset, id);
}

ItemId texelExactly(const ScreenTriangle& triangle, const IndexMap& map, const Pixel& pixel) {
  const int column = texelExactly(triangle, triangle.u, map.width, pixel.column, pixel.row);
  const int row = texelExactly(triangle, triangle.v, map.height, pixel.column, pixel.row);
  return static_cast<ItemId>(row) * static_cast<ItemId>(map.width) + static_cast<ItemId>(column);
}

}  // namespace hemitex::raster
