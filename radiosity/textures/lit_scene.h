/// Writes the lit scene: OBJ and MTL with radiosity textures, which any OBJ viewer shows.
#pragma once

#include <filesystem>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/texture_filter.h"

namespace hemitex::radiosity {

/// Writes to the existing `folder`: scene.obj, scene.mtl, and two files for each texture of the layout
/// (layOutTextures). NAME.png is the display texture: filtered and magnified by `textures`, with the ambient estimate,
/// times exposure, in sRGB. NAME.exr has one linear radiosity per texel in W/m^2, unfiltered, without ambient estimate
/// and exposure.
///
/// Triangles are grouped by surface, in the order and winding of the scene. A surface of one texel with different
/// corner values is Gouraud shaded. It has vertex colours, `v x y z r g b` with sRGB-encoded display values, and a
/// material without a map. Throws InputError if a file cannot be written.
///
/// loadScene reads the folder again, and unlitPicture draws it. render.png is made in this way from the 8-bit textures,
/// so that it equals the view in other programs.
void writeLitScene(const std::filesystem::path& folder, const Scene& scene, const Discretization& discretization,
                   const Solution& solution, double exposure, const TextureSettings& textures = {});

}  // namespace hemitex::radiosity
