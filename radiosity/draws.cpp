/// The scene as a draw list: offsets from the word layout, charts as texture coordinates, and one index map for each
/// size of grid, shared by all surfaces that have it.
#include <map>
#include <numeric>
#include <utility>

#include "radiosity/word_layout.h"

namespace hemitex::radiosity {
namespace {

/// Texel (column, row) holds row * columns + column.
raster::IndexMap indexMapOf(const Grid& grid) {
  raster::IndexMap map{grid.columns, grid.rows, std::vector<raster::Word>(grid.spill.size())};
  std::iota(map.words.begin(), map.words.end(), raster::Word{0});
  return map;
}

void appendTriangles(const Scene& scene, const Surface& surface, raster::DrawList& list) {
  for (const Triangle& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
      list.positions.emplace_back(triangle.position[k] - scene.origin);
      list.texcoords.emplace_back(triangle.chart[k]);
    }
}

}  // namespace

raster::DrawList makeDrawList(const Scene& scene, const Discretization& discretization, const WordLayout& layout) {
  raster::DrawList list;
  list.format = layout.format;
  list.blend = layout.blend;
  std::map<std::pair<int, int>, int> indexMaps;
  for (std::size_t surface = 0; surface < scene.surfaces.size(); ++surface) {
    const Grid& grid = discretization.grids[surface];
    raster::Draw draw;
    draw.first = static_cast<std::uint32_t>(list.indices.size());
    draw.offset = layout.offset[surface];
    draw.back = raster::backWord(layout.format);
    if (isDiscretized(grid)) {
      const auto [place, isNew] =
          indexMaps.try_emplace({grid.columns, grid.rows}, static_cast<int>(list.indexMaps.size()));
      if (isNew) list.indexMaps.push_back(indexMapOf(grid));
      draw.indexMap = place->second;
    }
    appendTriangles(scene, scene.surfaces[surface], list);
    draw.count = static_cast<std::uint32_t>(list.indices.size()) - draw.first;
    list.draws.push_back(draw);
  }
  return list;
}

}  // namespace hemitex::radiosity
