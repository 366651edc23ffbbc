#include "radiosity/index_maps/scene_draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace hemitex::radiosity {
namespace {

/// Texel (column, row) holds row * columns + column.
raster::IndexMap countingMap(const Page& page) {
  raster::IndexMap map{page.columns, page.rows, std::vector<raster::ItemId>(texelCount(page))};
  std::iota(map.ids.begin(), map.ids.end(), raster::ItemId{0});
  return map;
}

/// The number of a surface's map, which is appended if it is new; none if the offset alone is its item ID. `bySize` has
/// the shared maps so far.
std::optional<int> indexMapOf(const Grid& grid, const Page& page, bool isUnique,
                              std::map<std::pair<int, int>, int>& bySize, std::vector<raster::IndexMap>& maps) {
  if ((isUnique ? grid.elementCount : texelCount(page)) == 1) return std::nullopt;
  const auto next = static_cast<int>(maps.size());
  if (isUnique) {
    maps.push_back({grid.columns, grid.rows, grid.elementOfTexel});
    return next;
  }
  const auto [map, isNew] = bySize.try_emplace({page.columns, page.rows}, next);
  if (isNew) maps.push_back(countingMap(page));
  return map->second;
}

/// The index map of a cut-out, with the indices in its page of the texels of the grid.
raster::IndexMap holedMap(const Grid& grid, const RectanglePlace& place, const Page& page, bool isUnique) {
  const TexelMask& mask = *grid.mask;
  raster::IndexMap map{mask.columns, mask.rows, {}};
  map.ids.reserve(mask.isHole.size());
  for (int row = 0; row < mask.rows; ++row)
    for (int column = 0; column < mask.columns; ++column) {
      const int c = column / (mask.columns / grid.columns), r = row / (mask.rows / grid.rows);
      const std::uint32_t index = isUnique
                                      ? grid.elementOfTexel[static_cast<std::size_t>(r * grid.columns + c)]
                                      : static_cast<std::uint32_t>((place.row + r) * page.columns + place.column + c);
      map.ids.push_back(mask.isHole[map.ids.size()] ? raster::holeTexel : index);
    }
  return map;
}

/// The maps of cut-outs so far. Surfaces with equal masks share theirs if the indices are the same.
class HoledMaps {
 public:
  int of(const Grid& grid, const RectanglePlace& place, const Page& page, bool isUnique,
         std::vector<raster::IndexMap>& maps) {
    const auto next = static_cast<int>(maps.size());
    const std::array<int, 5> indices{page.columns, place.column, place.row, grid.columns, isUnique ? next : -1};
    const auto [known, isNew] = numbers_.try_emplace({grid.mask.get(), indices}, next);
    if (isNew) maps.push_back(holedMap(grid, place, page, isUnique));
    return known->second;
  }

 private:
  std::map<std::pair<const TexelMask*, std::array<int, 5>>, int> numbers_;
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
    if (grid.mask || (columns == grid.columns && rows == grid.rows)) return chart;
    return {inPage(chart.x, place.column, grid.columns, columns), inPage(chart.y, place.row, grid.rows, rows)};
  }
};

/// The lower corner of the period of a cut-out that shows all corners of triangles; nothing if no period does, if it is
/// mirrored, or if the image is too large for an index map.
std::optional<glm::dvec2> periodOf(const CutOut& cutOut, std::span<const Triangle> triangles) {
  if (std::max(cutOut.width, cutOut.height) > largestMask) return std::nullopt;
  glm::dvec2 low(std::numeric_limits<double>::max()), high = -low;
  for (const Triangle& triangle : triangles)
    for (const glm::dvec2& texcoord : triangle.texcoord) {
      low = glm::min(low, cutOut.sampler(texcoord));
      high = glm::max(high, cutOut.sampler(texcoord));
    }
  const glm::dvec2 period = glm::floor(low);
  if (high.x > period.x + 1 || high.y > period.y + 1) return std::nullopt;
  for (int axis = 0; axis < 2; ++axis)
    if (period[axis] != 0 && cutOut.sampler.wrap[static_cast<std::size_t>(axis)] != Wrap::Repeat) return std::nullopt;
  return period;
}

}  // namespace

raster::Draw& appendDraw(raster::DrawList& list, std::span<const Triangle> triangles, const Instance& instance,
                         const glm::dvec3& origin) {
  const auto first = static_cast<std::uint32_t>(list.indices.size());
  for (const Triangle& triangle : triangles)
    for (const glm::dvec3& position : placed(triangle, instance).position) {
      list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
      list.positions.emplace_back(position - origin);
    }
  list.texcoords.resize(list.positions.size());
  list.draws.push_back({.first = first, .count = static_cast<std::uint32_t>(list.indices.size()) - first, .back = {}});
  return list.draws.back();
}

void HoleMaps::cut(raster::DrawList& list, std::size_t draw, const Surface& surface,
                   std::span<const Triangle> triangles, const Instance& instance) {
  list.draws[draw].indexMap = std::nullopt;
  const CutOut* const cutOut = cutOutOf(scene_, surface);
  if (cutOut == nullptr) return;
  const std::optional<glm::dvec2> period = periodOf(*cutOut, triangles);
  const std::shared_ptr<const TexelMask> mask = period ? masks_.ofPixels(*cutOut) : masks_.of(surface, 1, 1);
  const auto [known, isNew] = numbers_.try_emplace(mask, static_cast<int>(list.indexMaps.size()));
  if (isNew) {
    raster::IndexMap map{mask->columns, mask->rows, {}};
    for (const bool isHole : mask->isHole) map.ids.push_back(isHole ? raster::holeTexel : 0);
    list.indexMaps.push_back(std::move(map));
  }
  list.draws[draw].indexMap = known->second;
  std::size_t corner = list.draws[draw].first;
  for (const Triangle& triangle : triangles) {
    const Triangle there = placed(triangle, instance);
    for (std::size_t k = 0; k < 3; ++k)
      list.texcoords[corner++] = period ? cutOut->sampler(there.texcoord[k]) - *period : there.chart[k];
  }
}

raster::DrawList makeDrawList(const Scene& scene, const Discretization& discretization, const IdLayout& layout) {
  raster::DrawList list;
  list.format = layout.format;
  list.blend = layout.blend;
  std::map<std::pair<int, int>, int> mapsBySize;
  HoledMaps holed;
  const bool isUnique = layout.indexMaps == IndexMaps::Unique;
  for (const Instance& instance : scene.instances)
    for (std::size_t surface = 0; surface < scene.surfaces.size(); ++surface) {
      const Grid& grid = discretization.grids[surface];
      const RectanglePlace& place = layout.places[surface];
      const Page& page = layout.pages[static_cast<std::size_t>(place.page)];
      const TexelPlace texels{grid, place, isUnique ? grid.columns : page.columns, isUnique ? grid.rows : page.rows};
      std::size_t corner = list.positions.size();
      const bool isImage = list.draws.size() >= scene.surfaces.size();
      raster::Draw& draw = appendDraw(list, scene.surfaces[surface].triangles, instance, scene.origin);
      draw.offset = page.offset;
      draw.back = raster::backId(layout.format);
      draw.indexMap = isImage     ? list.draws[surface].indexMap
                      : grid.mask ? std::optional(holed.of(grid, place, page, isUnique, list.indexMaps))
                                  : indexMapOf(grid, page, isUnique, mapsBySize, list.indexMaps);
      for (const Triangle& triangle : scene.surfaces[surface].triangles)
        for (const glm::dvec2& chart : placed(triangle, instance).chart)
          list.texcoords[corner++] = texels.coordinates(chart);
    }
  return list;
}

raster::DrawList drawListWithBlockers(const Scene& scene, const Discretization& discretization,
                                      const IdLayout& layout) {
  raster::DrawList list = makeDrawList(scene, discretization, layout);
  const raster::ItemId blocker = raster::backId(layout.format) - 1;
  HoleMaps holes(scene);
  for (std::size_t draw = scene.surfaces.size(); draw < list.draws.size(); ++draw) {
    list.draws[draw].offset = blocker;
    list.draws[draw].back = {};
    const Surface& surface = scene.surfaces[draw % scene.surfaces.size()];
    holes.cut(list, draw, surface, surface.triangles, scene.instances[draw / scene.surfaces.size()]);
  }
  return list;
}

}  // namespace hemitex::radiosity
