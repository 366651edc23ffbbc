#include "radiosity/index_maps/scene_draw_list.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace hemitex::radiosity {
namespace {

/// Texel (column, row) holds row * columns + column.
raster::IndexMap countingMap(const Page& page) {
  const auto texels = static_cast<std::size_t>(page.columns) * static_cast<std::size_t>(page.rows);
  raster::IndexMap map{page.columns, page.rows, std::vector<raster::ItemId>(texels)};
  std::iota(map.ids.begin(), map.ids.end(), raster::ItemId{0});
  return map;
}

/// The index maps of the draws so far.
class IndexMapPool {
 public:
  IndexMapPool(IndexMaps way, std::vector<raster::IndexMap>& maps) : way_(way), maps_(maps) {}

  /// The number of a surface's map; none if the offset alone is its item ID.
  std::optional<int> mapOf(const Grid& grid, const Page& page) {
    if (way_ == IndexMaps::Unique)
      return grid.elementCount == 1 ? std::nullopt : std::optional(add({grid.columns, grid.rows, grid.elementOfTexel}));
    if (page.columns * page.rows == 1) return std::nullopt;
    const auto [size, isNew] = bySize_.try_emplace({page.columns, page.rows}, static_cast<int>(maps_.size()));
    return isNew ? add(countingMap(page)) : size->second;
  }

 private:
  int add(raster::IndexMap map) {
    maps_.push_back(std::move(map));
    return static_cast<int>(maps_.size()) - 1;
  }

  IndexMaps way_;
  std::vector<raster::IndexMap>& maps_;
  std::map<std::pair<int, int>, int> bySize_;
};

/// Converts a chart coordinate to a page of `side` texels, strictly between the borders of the surface's texels.
float inPage(double chart, int start, int texels, int side) {
  const float low = static_cast<float>(start) / static_cast<float>(side);
  const float high = static_cast<float>(start + texels) / static_cast<float>(side);
  const auto moved = static_cast<float>((start + chart * texels) / side);
  return std::clamp(moved, std::nextafter(low, 2.0f), std::nextafter(high, 0.0f));
}

/// The place of a surface's texels in its index map.
struct TexelPlace {
  const Grid& grid;
  RectanglePlace place;
  int columns, rows;  ///< of the index map

  glm::vec2 coordinates(const glm::dvec2& chart) const {
    if (columns == grid.columns && rows == grid.rows) return chart;
    return {inPage(chart.x, place.column, grid.columns, columns), inPage(chart.y, place.row, grid.rows, rows)};
  }
};

void appendTriangles(const Scene& scene, const Surface& surface, const TexelPlace& place, raster::DrawList& list) {
  for (const Triangle& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
      list.positions.emplace_back(triangle.position[k] - scene.origin);
      list.texcoords.push_back(place.coordinates(triangle.chart[k]));
    }
}

}  // namespace

raster::DrawList makeDrawList(const Scene& scene, const Discretization& discretization, const IdLayout& layout) {
  raster::DrawList list;
  list.format = layout.format;
  list.blend = layout.blend;
  IndexMapPool maps(layout.indexMaps, list.indexMaps);
  const bool isUnique = layout.indexMaps == IndexMaps::Unique;
  for (std::size_t surface = 0; surface < scene.surfaces.size(); ++surface) {
    const Grid& grid = discretization.grids[surface];
    const RectanglePlace& place = layout.places[surface];
    const Page& page = layout.pages[static_cast<std::size_t>(place.page)];
    raster::Draw draw;
    draw.first = static_cast<std::uint32_t>(list.indices.size());
    draw.offset = page.offset;
    draw.back = raster::backId(layout.format);
    draw.indexMap = maps.mapOf(grid, page);
    const TexelPlace texels{grid, place, isUnique ? grid.columns : page.columns, isUnique ? grid.rows : page.rows};
    appendTriangles(scene, scene.surfaces[surface], texels, list);
    draw.count = static_cast<std::uint32_t>(list.indices.size()) - draw.first;
    list.draws.push_back(draw);
  }
  return list;
}

}  // namespace hemitex::radiosity
