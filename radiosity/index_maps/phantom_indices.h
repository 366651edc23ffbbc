/// Phantom form factors: indices that no texel with area produces, so that their form factors are always zero (Nielsen
/// and Christensen 2002, section 3.2). Rows are sparse, so that phantoms take neither memory nor time, only item IDs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"

namespace hemitex::radiosity {

/// Number of phantoms by cause.
struct Phantoms {
  std::uint64_t spareTexels = 0;    ///< texels of a page without area of a surface
  std::uint64_t alignmentGaps = 0;  ///< indices between the end of a page and the next aligned offset
};

/// `layout` is that of the discretization. Unique maps have no phantoms.
Phantoms countPhantoms(const Discretization& discretization, const IdLayout& layout);

/// The item IDs that a way of using index maps takes.
struct IndexMapUse {
  std::string name;
  std::size_t offsets = 0;  ///< number of pages
  std::uint64_t ids = 0;    ///< of texels with area; with unique maps, of elements
  Phantoms phantoms;
};

/// Compares the ways: shared maps, one shared map for all surfaces (of the smallest power of two), offsets without
/// alignment, packed pages (with the side that has the fewest phantoms), and unique maps. Throws InputError if one does
/// not fit 32 bits.
std::vector<IndexMapUse> compareIndexMaps(const Discretization& discretization);

}  // namespace hemitex::radiosity
