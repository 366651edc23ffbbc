/// Phantom form factors: indices that no texel with area produces, so that nothing ever arrives there (Nielsen and
/// Christensen 2002, 3.2). Rows are sparse, so that phantoms cost neither memory nor time there; what they use up is
/// the range of words.
#pragma once

#include <cstdint>

#include "radiosity/discretization.h"
#include "radiosity/word_layout.h"

namespace hemitex::radiosity {

/// By cause.
struct Phantoms {
  std::uint64_t spareTexels = 0;    ///< texels of a page without area of a surface
  std::uint64_t alignmentGaps = 0;  ///< indices between the end of a page and the next aligned offset
};

/// `layout` is that of the discretization. Unique maps have none.
Phantoms countPhantoms(const Discretization& discretization, const WordLayout& layout);

}  // namespace hemitex::radiosity
