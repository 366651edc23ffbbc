#include "raster/software/shading.h"

#include <cstddef>

#include "raster/setup/exact_interpolation.h"

namespace hemitex::raster {

std::optional<ItemId> addendOf(const PreparedDrawList& draws, const Draw& draw) {
  if (draws.list.blend == Blend::Replace) return 0;
  if ((draw.offset & draws.maps[static_cast<std::size_t>(*draw.indexMap)].bits) == 0) return draw.offset;
  return {};
}

Shading shadingOf(const PreparedDrawList& draws, const ScreenTriangle& triangle) {
  const DrawList& list = draws.list;
  const Draw& draw = list.draws[triangle.draw];
  if (!isTextured(list, draw, triangle.facesAway))
    return {idOf(draws, draw, triangle.number, triangle.facesAway, 0), {}};
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const PreparedDrawList::MapTraits& traits = draws.maps[static_cast<std::size_t>(*draw.indexMap)];
  const std::optional<ItemId> addend = addendOf(draws, draw);
  return {
      addend.value_or(draw.offset),
      Shading::Texels{
          &map, addend.has_value(), addend && traits.countsTexels, TexelPlanes(triangle, map.width, map.height), {}}};
}

ItemId idOf(const PreparedDrawList& draws, const Draw& draw, std::uint32_t t, bool facesAway, ItemId texel) {
  if (facesAway && draw.back) return *draw.back;
  if (draws.list.value == PixelValue::TriangleNumbers) return triangleNumber(draw, t);
  if (!draw.indexMap) return draw.offset;
  const auto map = static_cast<std::size_t>(*draw.indexMap);
  const ItemId value = draws.maps[map].countsTexels ? texel : draws.list.indexMaps[map].ids[texel];
  const std::optional<ItemId> addend = addendOf(draws, draw);
  return addend ? *addend + value : blend(draws.list.format, draws.list.blend, draw.offset, value);
}

ItemId texelExactly(const ScreenTriangle& triangle, const IndexMap& map, const Pixel& pixel) {
  const int column = texelExactly(triangle, triangle.u, map.width, pixel.column, pixel.row);
  const int row = texelExactly(triangle, triangle.v, map.height, pixel.column, pixel.row);
  return static_cast<ItemId>(row) * static_cast<ItemId>(map.width) + static_cast<ItemId>(column);
}

}  // namespace hemitex::raster
