/// The discretization of an edited scene: what was there keeps its grids, elements and patches, whatever was made of
/// them since (split patches, quadtrees), and what is new is discretized by itself.
#pragma once

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene_edits.h"

namespace hemitex::radiosity {

/// `before` is the discretization of the scene that the edit was made to. Patches are not split anew: those of what was
/// there stay, moved or not, and those of what is new are whole. What is new is exposed as a whole, and what
/// stays is exposed as it was: let the settings be unburied. A turned projection stands over a patch as it did.
Discretization carried(const Discretization& before, const EditedScene& edit, const DiscretizationSettings& settings);

}  // namespace hemitex::radiosity
