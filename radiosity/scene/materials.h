/// The materials of a scene: what its faces name, looked up in its MTL files, made physical, with the images of its
/// maps. What is missing becomes grey 0.5 and is told.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

struct MaterialSet {
  std::vector<Material> materials;  ///< one a name asked for
  std::vector<Image> images;
  std::vector<std::string> warnings;
};

/// Materials for `names` (an empty name asks for the material of faces that have none), looked up in `files`, where
/// the first definition of a name counts. Throws InputError as parseMaterials, and where a map holds a negative value.
/// - A file or a name that is missing: a warning, and reflectance 0.5 for the names that are in no file.
/// - A material without Kd: a warning and 0.5, or, where it has a map_Kd, the map alone. Without Ke it does not emit,
///   or emits what its map_Ke says.
/// - Emissions are converted from `settings.emission` to radiosity.
/// - A reflectance of 1 or more is lowered to `settings.maxReflectance`, with a warning for each material; the values
/// of a
///   map_Kd are lowered to 1.
/// - A map that is missing or cannot be read: a warning, and reflectance 0.5, or half the emission.
MaterialSet findMaterials(const std::vector<std::string>& names, const std::vector<std::filesystem::path>& files,
                          const SceneSettings& settings);

}  // namespace hemitex::radiosity
