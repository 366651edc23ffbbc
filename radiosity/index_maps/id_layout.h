/// The item ID layout: which item ID stands for which element. Item IDs come from index maps, and there are three ways
/// to use them (Nielsen and Christensen 2002, 3.1 and 3.2):
///
/// - *shared*: surfaces whose grids have one size share a map, and each has an offset of its own;
/// - *packed*: the grids of many surfaces lie side by side in a few square pages, which share one map, and each page
///   has an offset;
/// - *unique*: each surface has a map of its own, which holds the numbers of its elements. Texels that share an element
///   share the item ID, so that elements have any shape, and nothing is added.
///
/// A *page* is what an offset is given to: a surface's grid, or many. With shared and packed maps a page of more than
/// one texel takes an offset aligned to 2^k, where k bits hold the largest page, and a page of one texel a single item
/// ID behind them: a clamped add then never overflows a channel. Without alignment the offsets follow each other
/// without a gap, which only an integer add can draw. With unique maps a page is a surface's elements in a row.
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
  bool aligned = true;                              ///< unique maps need no offsets
  IndexMaps indexMaps = IndexMaps::Shared;
  /// Texels along the side of a page, a power of two up to 4096. With shared maps one map of this size serves all
  /// textured surfaces (Figure 2 of the paper), and without it one a size of grid. Packed pages are 64 without it, or
  /// as much more as the largest grid asks for.
  std::optional<int> page = {};
};

/// Texels under one offset: texel (column, row) has the item ID offset + row * columns + column.
struct Page {
  int columns = 1, rows = 1;
  raster::ItemId offset = 0;
};

struct IdLayout {
  raster::IdFormat format;
  raster::Blend blend = raster::Blend::ClampedAdd;
  bool aligned = true;
  IndexMaps indexMaps = IndexMaps::Shared;
  int indexBits = 0;                    ///< k: 2^k holds the largest page
  std::vector<Page> pages;              ///< one a surface, or packed ones
  std::vector<RectanglePlace> places;   ///< one a surface: where in which page its grid lies
  std::vector<std::uint32_t> byOffset;  ///< the pages in ascending order of their offsets
  std::uint32_t textured = 0;           ///< pages of more than a texel; where aligned, the first in byOffset
  /// With packed maps, the element that an item ID stands for, or noElement.
  std::vector<std::uint32_t> packedElements;
};

inline constexpr std::uint32_t noElement = 0xffffffff;

/// Throws InputError where no format has that name, where a page has no side that it may have or a grid does not fit
/// it, or where the scene does not fit the item ID (pages x 2^k over the format's range, two item IDs reserved); the
/// advice says which format, or which number of texels, would fit. Every offset plus index is below the reserved item
/// IDs, and so is what a clamped add makes of it: clamping only lowers a sum.
IdLayout layOut(const Discretization& discretization, const IdSettings& settings = {});

inline constexpr int largestPage = 4096;
/// The least power of two that is as long as the longest side of a grid.
int minPage(const Discretization& discretization);
/// The side of a packed page that was not asked for: 64, or the least page where that is larger.
int defaultPage(const Discretization& discretization);

/// How many surfaces an aligned layout holds, each with a grid of so many texels: with 2^k >= texels and the 2^m - 2
/// item IDs of use that m bits have, floor((2^m - 2 - texels) / 2^k) + 1. For whole maps of 2^k texels that is 2^(m-k)
/// - 1, for the last block ends with the two reserved item IDs.
std::uint64_t maxSurfaces(const raster::IdFormat& format, std::uint64_t texels);

/// A place in a page; in a unique map the index is the number of an element within its surface.
struct PageIndex {
  std::uint32_t page = 0;
  std::uint32_t index = 0;
};

/// What an item ID was added up from; nothing for the reserved item IDs and for item IDs that no draw can produce.
/// Where ClampedAdd changes an unaligned sum, it is that of the item ID it was changed into.
std::optional<PageIndex> pageIndexOf(const IdLayout& layout, raster::ItemId id);

/// The element that an item ID stands for: what the texel spills to that has the item ID. Nothing where no surface has
/// it.
std::optional<std::uint32_t> elementOf(const Discretization& discretization, const IdLayout& layout, raster::ItemId id);

/// The item ID of an element's own texel. elementOf is its inverse.
raster::ItemId idOf(const Discretization& discretization, const IdLayout& layout, std::uint32_t element);

}  // namespace hemitex::radiosity
