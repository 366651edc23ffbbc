/// Exposure: finds the parts of surfaces inside solids, which neither receive nor send light.
///
/// The outline of a solid on a surface cuts the surface's texels into pieces (triangle_slices.h), exactly. Pieces that
/// no outline separates form one region. The view from a few points of a region decides whether it is buried. Inside a
/// solid only the backs of faces are visible, whether or not the solid has a face where it stands. Inside overlapping
/// solids fronts are visible too, but those belong to buried regions. So a region is buried if the backs that it sees
/// outweigh the fronts of exposed regions that it sees.
#pragma once

#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The cut texels of each surface, one list per surface. `sizes` has the grid size of each surface. The list is empty
/// for a completely buried surface and for all surfaces of a scene in which all are two-sided, where no backs are visible.
std::vector<std::vector<CutTexel>> cutTexels(const Scene& scene, std::span<const GridSize> sizes);

}  // namespace hemitex::radiosity
