#include "radiosity/phantoms.h"

namespace hemitex::radiosity {
namespace {

std::uint64_t texelCount(int columns, int rows) {
  return static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
}

}  // namespace

Phantoms countPhantoms(const Discretization& discretization, const WordLayout& layout) {
  Phantoms phantoms;
  if (layout.indexMaps == IndexMaps::Unique) return phantoms;
  for (const Page& page : layout.pages) {
    const std::uint64_t texels = texelCount(page.columns, page.rows);
    phantoms.spareTexels += texels;
    if (layout.aligned && texels > 1) phantoms.alignmentGaps += (std::uint64_t{1} << layout.indexBits) - texels;
  }
  for (const Grid& grid : discretization.grids)
    phantoms.spareTexels -= texelCount(grid.columns, grid.rows) - grid.phantoms;
  return phantoms;
}

}  // namespace hemitex::radiosity
