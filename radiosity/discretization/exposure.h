/// Exposure: which parts of surfaces lie inside solids, where they neither receive nor send light.
///
/// Where a solid meets a surface its outline cuts the surface's texels into pieces (triangle_slices.h), exactly. Pieces
/// that no outline separates are one region, and what is seen from a few of its points says where the region lies:
/// inside a solid only the backs of faces are in view, whether or not the solid has a face where it stands. Solids that
/// overlap show each other's fronts inside, but those are fronts of buried regions as well. So a region is buried where
/// what it sees of backs outweighs what it sees of exposed fronts, other buried regions not counted.
#pragma once

#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The cut texels of every surface, one list a surface. `unburied` is the discretization of the scene as if all of it
/// were exposed. A surface of which nothing would be left, and every surface of a two-sided scene, where backs are in
/// no view, has none.
std::vector<std::vector<CutTexel>> cutTexels(const Scene& scene, const Discretization& unburied);

}  // namespace hemitex::radiosity
