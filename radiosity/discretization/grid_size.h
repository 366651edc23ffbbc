/// The number of texels of a surface, from a texel size or as requested, and the texel size with which a scene fills
/// packed pages.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

inline constexpr int largestGrid = 4096;  ///< maximum of columns and of rows

/// If the settings name no texels, returns them with a texel size derived from the scene. With it, all surfaces
/// together have about 90 elements per surface, or 2^16 if that is less. Grids then have sides of 1, 2, 4, ... 64
/// texels, so that large surfaces have many elements, small surfaces have few, and surfaces share index maps.
DiscretizationSettings followingScene(const Scene& scene, DiscretizationSettings settings);

/// The grid of a surface; the settings must name texels or a texel size.
///
/// Let S be the texel size, and L the length of a chart axis on the surface: |dP/du| or |dP/dv|, averaged by area. The
/// axis takes n = ceil(L / S) texels, up to the maximum. So a texel is at most S long. If L is at least S, the texel is
/// also longer than S/2. (Proof: L > (n - 1) S, and n - 1 >= n / 2.) A shorter axis has one texel. With powers of two,
/// n is the one nearest to L / S; then texels differ from S by a factor of at most sqrt(2).
GridSize gridSizeOf(const Surface& surface, const DiscretizationSettings& settings);

/// The grid of each surface, as `discretize` divides the scene: that of gridSizeOf. If the texels follow the scene,
/// long strips of one texel across have two if another front is nearer than their width, as slats of a blind.
std::vector<GridSize> gridSizesOf(const Scene& scene, const DiscretizationSettings& settings);

/// The number of texels of all grids. Phantoms make the number of elements smaller.
std::uint64_t totalTexels(std::span<const GridSize> sizes);

/// The memory that a run takes per element, as measured (see docs/performance.md).
inline constexpr std::uint64_t bytesPerElement = 100;

/// Throws InputError for 2^32 - 1 texels or more in total, because they and item IDs are 32-bit numbers. Throws
/// SizeError for more than 2^24, and if they do not fit into the free memory.
void requireAffordable(const Scene& scene, std::span<const GridSize> sizes);

/// Returns `settings` with the smallest texel size, to a thousandth, for which all grids fit `pages` packed pages (see
/// IndexMaps::Packed). Pages have side x side texels, and `side` is a power of two. No grid is longer than a page. For
/// a finer level with the same pages, set `subdivision` to 2 and double `side`. Throws InputError if even one texel per
/// surface does not fit.
DiscretizationSettings settingsForPages(const Scene& scene, int pages, int side, DiscretizationSettings settings = {});

}  // namespace hemitex::radiosity
