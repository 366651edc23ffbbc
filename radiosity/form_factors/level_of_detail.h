/// Levels of detail: coarser index maps for surfaces that cover few pixels (Nielsen and Christensen 2002, section 3,
/// expect less aliasing from them).
///
/// If a surface has more elements than pixels, each pixel gives all its light to one element, the one that its sample
/// selects. So it is random which elements are lit. The index map of level l has one index for 2^l x 2^l texels of the
/// grid. Maps are nested, and the texel of a sample does not depend on the map. So drawing with the coarser map gives
/// the item IDs of blocks that contain the finer ones. Therefore a level can be chosen after drawing, per surface and
/// per shot, when its pixels are counted.
///
/// The light of a block is distributed over its elements by area, as if it were uniform. Invisible elements of the
/// block also receive light, so that shadows become as soft as a block is wide.
///
/// docs/light.md has the errors without and with levels of detail.
#pragma once

#include <cstdint>
#include <span>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"

namespace hemitex::radiosity {

/// The best value in the measurements of docs/light.md.
inline constexpr double suggestedPixelsPerElement = 4;

/// Distributes the light of each surface over the blocks of a level, which is chosen per surface. It is the lowest
/// level at which visible blocks have on average at least `pixelsPerElement` pixels; the highest level is the whole
/// surface. `pixels` holds the number of pixels of each element of the row. The sum of each block stays exactly the
/// same.
FormFactorRow withCoarserMaps(const Discretization& discretization, const FormFactorRow& row,
                              std::span<const std::uint32_t> pixels, double pixelsPerElement);

}  // namespace hemitex::radiosity
