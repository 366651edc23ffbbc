/// Computes the discretization of a scene (see discretization.h).
#pragma once

#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// Throws InputError for a setting out of range, a name in surfaceTexels that no surface has, and more texels than
/// requireAffordable grants (grid_size.h). The sum of element areas equals the exposed area of each surface within
/// 1e-12, relative.
Discretization discretize(const Scene& scene, const DiscretizationSettings& settings);

/// As above, with the leaves of quadtrees as elements: one quadtree per surface, with the size of its grid. Also throws
/// InputError if the side of a patch is not a power of two, because patches consist of whole leaves.
Discretization discretize(const Scene& scene, const DiscretizationSettings& settings,
                          const std::vector<Quadtree>& quadtrees);

/// As above, with all surfaces exposed: the input for alternative computations of exposed areas.
Discretization discretizeUnburied(const Scene& scene, const DiscretizationSettings& settings);

/// Averages maps over the elements. discretize calls it; call it again after materials have changed.
void averageMaps(const Scene& scene, Discretization& discretization);

}  // namespace hemitex::radiosity
