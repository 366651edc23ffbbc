/// From a scene to its discretization (see discretization.h).
#pragma once

#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// Throws InputError on a setting out of range, a name in surfaceTexels that no surface has, and where there would be
/// 2^32 - 1 texels or more in all.
/// Element areas sum to the exposed area of each surface to 1e-12 relative.
Discretization discretize(const Scene& scene, const DiscretizationSettings& settings);

/// The same with the leaves of quadtrees as elements: one a surface, over a grid of as many columns and rows. Throws
/// InputError also where the side of a patch is not a power of two: patches consist of whole leaves.
Discretization discretize(const Scene& scene, const DiscretizationSettings& settings,
                          const std::vector<Quadtree>& quadtrees);

/// The same with settings that are unburied: what other ways to find exposed areas start from.
Discretization discretizeUnburied(const Scene& scene, const DiscretizationSettings& settings);

/// What discretize also does: maps averaged over the elements. Again where materials have changed since.
void averageMaps(const Scene& scene, Discretization& discretization);

}  // namespace hemitex::radiosity
