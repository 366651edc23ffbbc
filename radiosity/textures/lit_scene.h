/// Writes the lit scene: OBJ and MTL with radiosity textures, which any OBJ viewer shows.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "radiosity/textures/texture_filter.h"

namespace hemitex::radiosity {

/// A scene as loadScene reads it from the files of writeLitScene: unlitPicture shows its light.
struct LitScene {
  Scene scene;
  TextureLayout layout;  ///< texture t is the reflectance map of material t
};

/// The surfaces of a scene, lit. The reflectance map of a surface is its display texture: `displayed` (see
/// displayRadiosity), in W/m^2 per element, times `exposure`, filtered and magnified as `textures` says, with the 256
/// values that an 8-bit sRGB file holds. A surface of one texel whose corners differ is Gouraud shaded instead: its
/// triangles have corner colours, and its material, the last one, has no map.
LitScene makeLitScene(const Scene& scene, const Discretization& discretization,
                      const std::vector<glm::dvec3>& displayed, double exposure, const TextureSettings& textures = {});

/// Writes into `folder`, which exists: scene.obj, scene.mtl and per texture NAME.png, the display texture, and
/// NAME.exr, the linear `radiosity` of the elements in W/m^2, one texel per texel of the grid. Triangles are grouped by
/// surface, in the order and winding of the scene; Gouraud shaded ones have colours at their vertices, `v x y z r g b`,
/// encoded in sRGB. Throws InputError where a file cannot be written.
void writeLitScene(const std::filesystem::path& folder, const LitScene& lit, const Discretization& discretization,
                   const std::vector<glm::dvec3>& radiosity);

}  // namespace hemitex::radiosity
