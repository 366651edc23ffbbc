/// The lit scene as files: OBJ and MTL with radiosity textures, so that any viewer of OBJ files shows the light.
#pragma once

#include <filesystem>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/texture_filter.h"

namespace hemitex::radiosity {

/// Writes into `folder`, which exists: scene.obj, scene.mtl and, for every texture of the layout (layOutTextures),
/// NAME.png, the display texture (filtered and magnified as `textures` says, with the ambient estimate, times exposure,
/// in sRGB), and NAME.exr, one linear radiosity a texel in W/m^2 (unfiltered, without ambient estimate and exposure).
/// Triangles are grouped by surface, in the order and winding of the scene. A surface of one texel whose corners differ
/// is Gouraud shaded: it has colours at its vertices, `v x y z r g b` with the sRGB-encoded display values, and a
/// material without a map. Throws InputError where a file cannot be written.
///
/// loadScene reads the folder back, and unlitPicture shows it: render.png is made that way, from the 8-bit textures
/// that everyone else sees.
void writeLitScene(const std::filesystem::path& folder, const Scene& scene, const Discretization& discretization,
                   const Solution& solution, double exposure, const TextureSettings& textures = {});

}  // namespace hemitex::radiosity
