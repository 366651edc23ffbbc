/// The item ID layout: assigns item IDs to elements. Item IDs come from index maps, which can be used in three ways
/// (Nielsen and Christensen 2002, sections 3.1 and 3.2):
///
/// - *shared*: surfaces whose grids have the same size share a map, and each surface has its own offset;
/// - *packed*: the grids of many surfaces lie side by side in a few square pages, which share one map, and each page
///   has an offset;
/// - *unique*: each surface has its own map, which holds the numbers of its elements. Texels of the same element have
///   the same item ID, so that elements have any shape. There are no offsets.
///
/// A *page* is the unit that has an offset: the grid of one surface, or of many. With shared and packed maps, a page of
/// more than one texel has an offset aligned to 2^k, where k bits hold the largest page. Pages of one texel follow and
/// take one item ID each. A clamped add then never overflows a channel. Without alignment the offsets have no gaps,
/// which needs an integer add. With unique maps a page is the list of a surface's elements.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/geometry/rectangle_packing.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_id.h"

namespace hemitex::radiosity {

enum class IndexMaps { Shared, Packed, Unique };

struct IdSettings {
  std::string format = "r8g8b8a8";                  ///< see raster::formatNamed
  raster::Blend blend = raster::Blend::ClampedAdd;  ///< or IntegerAdd; unique maps replace
  bool aligned = true;                              ///< ignored for unique maps
  IndexMaps indexMaps = IndexMaps::Shared;
  /// Texels along the side of a page, a power of two up to 4096. With shared maps, one map of this size serves all
  /// textured surfaces (Figure 2 of the paper); without a value there is one map per grid size. The default for packed
  /// pages is 64, or more if the largest grid needs it.
  std::optional<int> page = {};
};

/// Texels under one offset: texel (column, row) has the item ID offset + row * columns + column.
struct Page {
  int columns = 1, rows = 1;
  raster::ItemId offset = 0;
};

/// The number of texels of a page or a grid.
template <typename Rectangle>
std::uint64_t texelCount(const Rectangle& rectangle) {
  return static_cast<std::uint64_t>(rectangle.columns) * static_cast<std::uint64_t>(rectangle.rows);
}

struct IdLayout {
  raster::IdFormat format;
  raster::Blend blend = raster::Blend::ClampedAdd;
  bool aligned = true;
  IndexMaps indexMaps = IndexMaps::Shared;
  int indexBits = 0;                    ///< k: 2^k holds the largest page
  std::vector<Page> pages;              ///< one per surface, or the packed pages
  std::vector<RectanglePlace> places;   ///< one per surface: the page and the place of its grid
  std::vector<std::uint32_t> byOffset;  ///< the pages in ascending order of their offsets
  std::uint32_t textured =
      0;  ///< number of pages with more than one texel; if aligned, these are the first in byOffset
  /// With packed maps, the element of each item ID, or noElement.
  std::vector<std::uint32_t> packedElements;
};

inline constexpr std::uint32_t noElement = 0xffffffff;

/// Throws InputError for an unknown format name, an invalid page side, and a grid that does not fit its page. Also
/// throws it if the scene needs more item IDs than the format has, with two item IDs reserved. The advice says which
/// format or which number of texels would fit. Each offset plus index is below the reserved item IDs, also after a
/// clamped add, because clamping only lowers a sum.
IdLayout layOut(const Discretization& discretization, const IdSettings& settings = {});

inline constexpr int largestPage = 4096;
/// The smallest power of two that is at least as long as the longest side of a grid.
int minPage(const Discretization& discretization);
/// The default side of a packed page: 64, or minPage if that is larger.
int defaultPage(const Discretization& discretization);

/// The number of surfaces that an aligned layout can hold, each with a grid of `texels` texels. With 2^k >= texels and
/// 2^m - 2 usable item IDs of m bits it is floor((2^m - 2 - texels) / 2^k) + 1. For maps of 2^k texels that is 2^(m-k)
/// - 1, because the last block ends with the two reserved item IDs.
std::uint64_t maxSurfaces(const raster::IdFormat& format, std::uint64_t texels);

/// A place in a page; in a unique map the index is the number of an element within its surface.
struct PageIndex {
  std::uint32_t page = 0;
  std::uint32_t index = 0;
};

/// The page and index of an item ID; nothing for reserved item IDs and those that no draw can produce. With an
/// unaligned ClampedAdd, the clamped item ID counts.
std::optional<PageIndex> pageIndexOf(const IdLayout& layout, raster::ItemId id);

/// The element of an item ID, by the texel-to-element map; nothing if no surface has the item ID.
std::optional<std::uint32_t> elementOf(const Discretization& discretization, const IdLayout& layout, raster::ItemId id);

/// The item ID of an element's own texel. elementOf is its inverse.
raster::ItemId idOf(const Discretization& discretization, const IdLayout& layout, std::uint32_t element);

}  // namespace hemitex::radiosity
