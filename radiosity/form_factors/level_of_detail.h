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
/// The tables show errors without and with levels of detail at 4 pixels per visible element. Grids have 32 and 64
/// texels with 256 and 164 patches, and hemicubes are rotated per patch. The reference has the same patches and R =
/// 1024 or 512. `row` is the sum of the errors of a row, and `flux` the sum of all errors of radiosity over all light.
/// `rough` is the root mean square of an element's error minus the mean error of its neighbours, over the mean
/// radiosity; it measures visible aliasing.
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
/// Fewer pixels per element (2) leave more aliasing; more (8) blur more. With 32 texels and R = 32 on the Cornell box,
/// the flux errors are 0.038 and 0.052, and the roughness 0.044 and 0.039. A level per block instead of per surface
/// would improve little (row 0.14, flux 0.045, rough 0.037).
#pragma once

#include <cstdint>
#include <span>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"

namespace hemitex::radiosity {

/// The best value in these measurements.
inline constexpr double suggestedPixelsPerElement = 4;

/// Distributes the light of each surface over the blocks of a level, which is chosen per surface. It is the lowest
/// level at which visible blocks have on average at least `pixelsPerElement` pixels; the highest level is the whole
/// surface. `pixels` holds the number of pixels of each element of the row. The sum of each block stays exactly the
/// same.
FormFactorRow withCoarserMaps(const Discretization& discretization, const FormFactorRow& row,
                              std::span<const std::uint32_t> pixels, double pixelsPerElement);

}  // namespace hemitex::radiosity
