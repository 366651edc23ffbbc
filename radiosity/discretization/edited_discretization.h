/// The discretization of an edited scene. Kept surfaces keep their grids, elements and patches, including split patches
/// and quadtrees. New surfaces are discretized from scratch.
#pragma once

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene_edits.h"

namespace hemitex::radiosity {

/// `before` is the discretization of the scene before the edit. Kept patches, moved or not, are not split again; new
/// patches are not split. New surfaces are completely exposed and kept ones are exposed as before, so that the settings
/// should be unburied. Projections that are rotated per patch keep their rotation.
Discretization carried(const Discretization& before, const EditedScene& edit, const DiscretizationSettings& settings);

}  // namespace hemitex::radiosity
