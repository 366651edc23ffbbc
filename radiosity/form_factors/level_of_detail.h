/// Levels of detail: coarser index maps where a surface covers few pixels (Nielsen and Christensen 2002, section 3,
/// expect less aliasing from them).
///
/// A hemicube that sees a surface in fewer pixels than it has elements gives all of a pixel's light to the one element
/// that its sample meets, and none to those around it: which of them glow is chance. The index map of level l has one
/// index for 2^l x 2^l texels of the grid. Maps are nested, and a sample's texel does not depend on them, so drawing
/// with the coarser map gives the very item IDs that its blocks make of the finer one's: a level may be chosen after
/// drawing, for each surface and each shot, when its pixels are counted.
///
/// The light of a block is spread over its elements by their areas, as if it fell evenly: also over those that the eye
/// does not see, which makes shadows as soft as a block is wide.
///
/// What that is worth, with 4 pixels for each element in view and without it: grids of 32 and 64 texels with 256 and
/// 164 patches, turned hemicubes; the truth has the same patches and R = 1024 or 512. `row` is the sum of a row's
/// errors, `flux` the sum of all errors of radiosity over all light, `rough` the root mean square of an element's error
/// less the mean of its neighbours', over the mean radiosity: what aliasing does to pictures.
///
///     cornell-box    row             flux              rough
///     32, R =  32    0.50  -> 0.16   0.107  -> 0.047   0.37  -> 0.038
///     32, R =  64    0.20  -> 0.10   0.043  -> 0.026   0.16  -> 0.032
///     32, R = 128    0.077 -> 0.057  0.017  -> 0.012   0.064 -> 0.025
///     32, R = 256    0.031 -> 0.025  0.0067 -> 0.0048  0.021 -> 0.012
///     64, R =  32    0.97  -> 0.17   0.24   -> 0.050   0.77  -> 0.041
///     64, R =  64    0.50  -> 0.13   0.110  -> 0.030   0.39  -> 0.033
///     64, R = 128    0.20  -> 0.10   0.044  -> 0.019   0.17  -> 0.031
///
///     pyramid-room   row             flux              rough
///     32, R =  32    0.71  -> 0.19   0.076  -> 0.035   0.16  -> 0.032
///     32, R =  64    0.28  -> 0.14   0.029  -> 0.018   0.069 -> 0.024
///     32, R = 128    0.100 -> 0.081  0.011  -> 0.009   0.024 -> 0.014
///     32, R = 256    0.037 -> 0.035  0.0042 -> 0.0040  0.009 -> 0.008
///     64, R =  32    1.30  -> 0.21   0.19   -> 0.037   0.37  -> 0.026
///     64, R =  64    0.71  -> 0.17   0.076  -> 0.022   0.16  -> 0.023
///     64, R = 128    0.28  -> 0.14   0.030  -> 0.015   0.069 -> 0.021
///
/// Fewer pixels (2) leave more aliasing, more (8) blur more: with 32 texels and R = 32 the fluxes' errors on the
/// Cornell box are 0.038 and 0.052 there, the roughness 0.044 and 0.039. A level for each block instead of each surface
/// would gain little more (row 0.14, flux 0.045, rough 0.037).
#pragma once

#include <cstdint>
#include <span>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"

namespace hemitex::radiosity {

/// What was worth most where it was measured.
inline constexpr double suggestedPixelsPerElement = 4;

/// The row with the light of each surface spread over the blocks of a level of its own: the lowest at which the blocks
/// in view have on average at least `pixelsPerElement` pixels each, or all of the surface as one. `pixels` are those in
/// which each of the row's elements is seen. The sum of every block is what it was, to the last bit.
FormFactorRow withCoarserMaps(const Discretization& discretization, const FormFactorRow& row,
                              std::span<const std::uint32_t> pixels, double pixelsPerElement);

}  // namespace hemitex::radiosity
