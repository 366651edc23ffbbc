#include "radiosity/index_maps/phantom_indices.h"

#include <optional>
#include <utility>

namespace hemitex::radiosity {
namespace {

std::uint64_t sum(const Phantoms& phantoms) { return phantoms.spareTexels + phantoms.alignmentGaps; }

IndexMapUse useOf(const std::string& name, const Discretization& discretization, IdSettings settings) {
  settings.format = "r32ui";
  const IdLayout layout = layOut(discretization, settings);
  std::uint64_t ids = 0;
  for (const Grid& grid : discretization.grids)
    ids += settings.indexMaps == IndexMaps::Unique ? grid.elementCount : texelCount(grid) - grid.phantoms;
  return {name, layout.pages.size(), ids, countPhantoms(discretization, layout)};
}

/// Pages longer than one that holds everything have more phantoms.
IndexMapUse fewestPhantoms(const Discretization& discretization) {
  std::optional<IndexMapUse> best;
  for (int page = minPage(discretization); page <= largestPage; page *= 2) {
    const std::string side = std::to_string(page);
    IndexMapUse use =
        useOf("packed, " + side + " x " + side, discretization, {.indexMaps = IndexMaps::Packed, .page = page});
    const bool holdsAll = use.offsets == 1;
    if (!best || sum(use.phantoms) < sum(best->phantoms)) best = std::move(use);
    if (holdsAll) break;
  }
  return *best;
}

}  // namespace

Phantoms countPhantoms(const Discretization& discretization, const IdLayout& layout) {
  Phantoms phantoms;
  if (layout.indexMaps == IndexMaps::Unique) return phantoms;
  for (const Page& page : layout.pages) {
    const std::uint64_t texels = texelCount(page);
    phantoms.spareTexels += texels;
    if (layout.aligned && texels > 1) phantoms.alignmentGaps += (std::uint64_t{1} << layout.indexBits) - texels;
  }
  for (const Grid& grid : discretization.grids) phantoms.spareTexels -= texelCount(grid) - grid.phantoms;
  return phantoms;
}

std::vector<IndexMapUse> compareIndexMaps(const Discretization& discretization) {
  return {useOf("shared", discretization, {}),
          useOf("shared, one map", discretization, {.page = minPage(discretization)}),
          useOf("shared, unaligned", discretization, {.blend = raster::Blend::IntegerAdd, .aligned = false}),
          fewestPhantoms(discretization), useOf("unique", discretization, {.indexMaps = IndexMaps::Unique})};
}

}  // namespace hemitex::radiosity
