/// Phantom form factors: indices that no texel with area produces, so that nothing ever arrives there (Nielsen and
/// Christensen 2002, 3.2). Rows are sparse, so that phantoms cost neither memory nor time there; what they use up is
/// the range of item IDs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"

namespace hemitex::radiosity {

/// By cause.
struct Phantoms {
  std::uint64_t spareTexels = 0;    ///< texels of a page without area of a surface
  std::uint64_t alignmentGaps = 0;  ///< indices between the end of a page and the next aligned offset
};

/// `layout` is that of the discretization. Unique maps have none.
Phantoms countPhantoms(const Discretization& discretization, const IdLayout& layout);

/// What a way to use index maps takes of the range of item IDs.
struct IndexMapUse {
  std::string name;
  std::size_t offsets = 0;  ///< pages
  std::uint64_t ids = 0;    ///< that stand for texels with area; with unique maps, for elements
  Phantoms phantoms;
};

/// The ways beside each other: shared maps, one shared map for all surfaces (of the least power of two), offsets
/// without alignment, packed pages (of the side that leaves the fewest phantoms) and unique maps. Throws InputError
/// where one does not fit 32 bits.
std::vector<IndexMapUse> compareIndexMaps(const Discretization& discretization);

}  // namespace hemitex::radiosity
