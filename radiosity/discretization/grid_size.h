/// How many texels a surface takes, from its size or as it was asked for, and the texel size with which a scene fills
/// packed pages.
#pragma once

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

inline constexpr int largestGrid = 4096;  ///< columns, and rows

/// The settings with the texel size that follows the scene where they name none: a size with which all surfaces
/// together have about 90 elements per surface, or 2^16 where that is less. Grids then have sides of 1, 2, 4, ... 64
/// texels, so that large surfaces have many elements, small ones few, and index maps are shared.
DiscretizationSettings followingScene(const Scene& scene, DiscretizationSettings settings);

/// The grid of a surface, of settings that name texels or their size. With a texel size S, an axis of the chart takes n
/// = ceil(L / S) texels or the most, where L is the length of the whole axis on the surface, |dP/du| or |dP/dv|
/// averaged by area. So a texel is no longer than S along it and, where the axis is at least S long, longer than S/2 (L
/// > (n - 1) S, and n - 1 >= n / 2): within a factor of two of what was asked for. A shorter axis is one texel. Where
/// numbers are powers of two it takes the one nearest to L / S, so that a texel is longer or shorter than S by a factor
/// of at most sqrt(2).
GridSize gridSizeOf(const Surface& surface, const DiscretizationSettings& settings);

/// `settings` with the smallest texel size, to a thousandth, with which the grids of all surfaces fit `pages` packed
/// pages of side x side texels (a power of two; see IndexMaps::Packed); no grid is longer than a page. For finer levels
/// that fit as many pages, set `subdivision` to 2 and double the pages' side. Throws InputError where even one texel a
/// surface does not fit.
DiscretizationSettings settingsForPages(const Scene& scene, int pages, int side, DiscretizationSettings settings = {});

}  // namespace hemitex::radiosity
