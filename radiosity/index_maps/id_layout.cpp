#include "radiosity/index_maps/id_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <utility>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

using raster::IdFormat;
using raster::InputError;
using raster::ItemId;

bool isTextured(const Page& page) { return texelCount(page) > 1; }

/// The number of item IDs that draws may produce: all except the two reserved ones.
std::uint64_t capacity(const IdFormat& format) { return std::uint64_t{raster::backId(format)}; }

std::string listedNames() {
  std::string names;
  for (const std::string& name : raster::formatNames()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void validatePage(const Discretization& discretization, int page) {
  if (page < 1 || page > largestPage || !std::has_single_bit(static_cast<unsigned>(page)))
    throw InputError("a page has " + std::to_string(page) + " texels along its side",
                     "use a power of two up to " + std::to_string(largestPage));
  if (const int least = minPage(discretization); least > page)
    throw InputError("a surface has more than the " + std::to_string(page) + " texels of a page along a side",
                     "use a page of " + std::to_string(least) + " texels, or fewer texels a surface");
}

/// One page per surface, of the size of its grid or of `page`. With unique maps a page has the elements in order: the
/// item IDs are the element numbers.
void makeOwnPages(const Discretization& discretization, const IdSettings& settings, IdLayout& layout) {
  for (const Grid& grid : discretization.grids) {
    layout.places.push_back({static_cast<int>(layout.pages.size()), 0, 0});
    if (settings.indexMaps == IndexMaps::Unique)
      layout.pages.push_back({static_cast<int>(grid.elementCount), 1});
    else if (settings.page && isDiscretized(grid))
      layout.pages.push_back({*settings.page, *settings.page});
    else
      layout.pages.push_back({grid.columns, grid.rows});
  }
}

void makePackedPages(const Discretization& discretization, int side, IdLayout& layout) {
  std::vector<RectangleSize> sizes;
  for (const Grid& grid : discretization.grids) sizes.push_back({grid.columns, grid.rows});
  Packing packing = packRectangles(sizes, side);
  layout.places = std::move(packing.places);
  layout.pages.assign(packing.pages.size(), Page{side, side});
}

void makePages(const Discretization& discretization, const IdSettings& settings, IdLayout& layout) {
  if (settings.page && settings.indexMaps != IndexMaps::Unique) validatePage(discretization, *settings.page);
  if (settings.indexMaps != IndexMaps::Packed) return makeOwnPages(discretization, settings, layout);
  makePackedPages(discretization, settings.page.value_or(defaultPage(discretization)), layout);
}

/// The number of item IDs for `textured` surfaces of texels x texels and `singles` of one texel.
std::uint64_t idsNeeded(std::uint64_t textured, std::uint64_t singles, std::uint64_t texels, bool aligned) {
  const std::uint64_t indices = texels * texels;
  if (!aligned || textured == 0 || indices == 1) return textured * indices + singles;
  const std::uint64_t block = std::bit_ceil(indices);
  return singles > 0 ? textured * block + singles : (textured - 1) * block + indices;
}

/// The narrowest format with enough item IDs; empty if there is none.
std::string formatAdvice(std::uint64_t ids) {
  for (const std::string& name : raster::formatNames())
    if (ids <= capacity(*raster::formatNamed(name))) return "use the format " + name;
  return {};
}

/// The number of texels along a side that would fit; empty if not even one does, or if pages are packed.
std::string texelAdvice(const IdLayout& layout) {
  if (layout.indexMaps == IndexMaps::Packed) return {};
  const std::uint64_t singles = layout.pages.size() - layout.textured;
  const auto fits = [&](std::uint64_t texels) {
    return idsNeeded(layout.textured, singles, texels, layout.aligned) <= capacity(layout.format);
  };
  std::uint64_t texels = 4096;
  while (texels > 0 && !fits(texels)) --texels;
  const std::string side = std::to_string(texels);
  return texels > 0 ? "give a surface " + side + " x " + side + " texels at most" : "";
}

[[noreturn]] void throwTooLarge(const IdLayout& layout, const std::string& formatName, std::uint64_t ids) {
  const std::string format = formatAdvice(ids), texels = texelAdvice(layout);
  const std::string advice = format + (format.empty() || texels.empty() ? "" : ", or ") + texels;
  throw InputError("the scene needs " + std::to_string(ids) + " item IDs, but " + formatName + " has " +
                       std::to_string(capacity(layout.format)) + " of use",
                   advice.empty() ? "no format has as many: use fewer surfaces" : advice);
}

/// Assigns offsets to the pages.
void layOutPages(IdLayout& layout, const std::string& formatName) {
  for (const Page& page : layout.pages) {
    layout.textured += isTextured(page) ? 1 : 0;
    layout.indexBits = std::max(layout.indexBits, static_cast<int>(std::bit_width(texelCount(page) - 1)));
  }
  layout.byOffset.resize(layout.pages.size());
  std::iota(layout.byOffset.begin(), layout.byOffset.end(), 0u);
  if (layout.aligned)
    std::stable_partition(layout.byOffset.begin(), layout.byOffset.end(),
                          [&](std::uint32_t page) { return isTextured(layout.pages[page]); });
  // In 64 bits, so that an overflow of 32 bits is detected.
  std::uint64_t ids = 0, nextTextured = 0, nextSingle = std::uint64_t{layout.textured} << layout.indexBits;
  for (Page& page : layout.pages) {
    const std::uint64_t offset = !layout.aligned    ? ids
                                 : isTextured(page) ? nextTextured++ << layout.indexBits
                                                    : nextSingle++;
    ids = std::max(ids, offset + texelCount(page));
    page.offset = static_cast<ItemId>(offset);
  }
  if (ids > capacity(layout.format)) throwTooLarge(layout, formatName, ids);
}

ItemId idOfTexel(const IdLayout& layout, std::size_t surface, std::uint32_t column, std::uint32_t row) {
  const RectanglePlace& place = layout.places[surface];
  const Page& page = layout.pages[static_cast<std::size_t>(place.page)];
  return page.offset + (static_cast<ItemId>(place.row) + row) * static_cast<ItemId>(page.columns) +
         static_cast<ItemId>(place.column) + column;
}

/// Packed pages are squares of one size without gaps between offsets, so that item IDs count from 0.
std::vector<std::uint32_t> packedElements(const Discretization& discretization, const IdLayout& layout) {
  std::vector<std::uint32_t> elements(layout.pages.size() * texelCount(layout.pages.front()), noElement);
  for (std::size_t surface = 0; surface < discretization.grids.size(); ++surface) {
    const Grid& grid = discretization.grids[surface];
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    for (std::uint32_t texel = 0; texel < grid.elementOfTexel.size(); ++texel)
      elements[idOfTexel(layout, surface, texel % columns, texel / columns)] = grid.elementOfTexel[texel];
  }
  return elements;
}

std::optional<std::uint32_t> elementInOwnPage(const Grid& grid, const Page& page, std::uint32_t index) {
  if (page.columns == grid.columns && page.rows == grid.rows) return grid.elementOfTexel[index];
  const auto columns = static_cast<std::uint32_t>(page.columns), gridColumns = static_cast<std::uint32_t>(grid.columns);
  const std::uint32_t column = index % columns, row = index / columns;
  if (column >= gridColumns || row >= static_cast<std::uint32_t>(grid.rows)) return std::nullopt;
  return grid.elementOfTexel[row * gridColumns + column];
}

}  // namespace

std::uint64_t maxSurfaces(const IdFormat& format, std::uint64_t texels) {
  if (texels > capacity(format)) return 0;
  return (capacity(format) - texels) / std::bit_ceil(texels) + 1;
}

int minPage(const Discretization& discretization) {
  int side = 1;
  for (const Grid& grid : discretization.grids) side = std::max({side, grid.columns, grid.rows});
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(side)));
}

int defaultPage(const Discretization& discretization) { return std::max(64, minPage(discretization)); }

IdLayout layOut(const Discretization& discretization, const IdSettings& settings) {
  assert(settings.blend != raster::Blend::Replace);
  const std::optional<IdFormat> format = raster::formatNamed(settings.format);
  if (!format)
    throw InputError("'" + settings.format + "' is not an item ID format", "the formats are " + listedNames());
  const bool isUnique = settings.indexMaps == IndexMaps::Unique;
  IdLayout layout;
  layout.format = *format;
  layout.blend = isUnique ? raster::Blend::Replace : settings.blend;
  layout.aligned = settings.aligned && !isUnique;
  layout.indexMaps = settings.indexMaps;
  makePages(discretization, settings, layout);
  layOutPages(layout, settings.format);
  if (layout.indexMaps == IndexMaps::Packed && !layout.pages.empty())
    layout.packedElements = packedElements(discretization, layout);
  return layout;
}

std::optional<PageIndex> pageIndexOf(const IdLayout& layout, ItemId id) {
  std::uint32_t page = 0;
  if (!layout.aligned) {
    const auto next = std::upper_bound(layout.byOffset.begin(), layout.byOffset.end(), id,
                                       [&](ItemId w, std::uint32_t p) { return w < layout.pages[p].offset; });
    if (next == layout.byOffset.begin()) return std::nullopt;
    page = *(next - 1);
  } else if (const ItemId block = id >> layout.indexBits; block < layout.textured) {
    page = layout.byOffset[block];
  } else {
    const std::uint64_t place = id - (std::uint64_t{layout.textured} << layout.indexBits) + layout.textured;
    if (place >= layout.byOffset.size()) return std::nullopt;
    page = layout.byOffset[place];
  }
  const ItemId index = id - layout.pages[page].offset;
  if (index >= texelCount(layout.pages[page])) return std::nullopt;
  return PageIndex{page, index};
}

std::optional<std::uint32_t> elementOf(const Discretization& discretization, const IdLayout& layout, ItemId id) {
  if (layout.indexMaps == IndexMaps::Unique)
    return id < discretization.elements.size() ? std::optional(id) : std::nullopt;
  if (layout.indexMaps == IndexMaps::Packed)
    return id < layout.packedElements.size() && layout.packedElements[id] != noElement
               ? std::optional(layout.packedElements[id])
               : std::nullopt;
  const std::optional<PageIndex> place = pageIndexOf(layout, id);
  if (!place) return std::nullopt;
  return elementInOwnPage(discretization.grids[place->page], layout.pages[place->page], place->index);
}

ItemId idOf(const Discretization& discretization, const IdLayout& layout, std::uint32_t element) {
  if (layout.indexMaps == IndexMaps::Unique) return element;
  const Element& own = discretization.elements[element];
  const auto columns = static_cast<std::uint32_t>(discretization.grids[own.surface].columns);
  return idOfTexel(layout, own.surface, own.texel % columns, own.texel / columns);
}

}  // namespace hemitex::radiosity
