/// The materials of a scene: looks up the names that faces use in the MTL files, makes the values physically valid, and
/// reads the images of maps. Missing values become grey 0.5, with a warning.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {

/// The reflectance, or the share of the emission, where a file states none or cannot be read.
inline constexpr double grey = 0.5;

struct MaterialSet {
  std::vector<Material> materials;  ///< one per requested name
  std::vector<Image> images;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files = {};  ///< those that were read
};

/// The warning, without its subject, for a material that lets light through by a statement of its file.
std::string opaqueWarning(const std::string& statement);

/// What all images of a scene together are called in messages about memory.
inline constexpr const char* imagesOfScene = "the set of images of its materials";

/// The image of a set with a sampler: itself for the first one that asks, else a copy. `variants` are the numbers given
/// so far. `memory` is asked for copies.
int withSampler(MaterialSet& set, int image, const Sampler& sampler, std::vector<int>& variants,
                raster::RunningRequest& memory);

/// Lowers bands of 1 or more to `maxReflectance`. Returns a warning without its subject, or nothing if none is lowered.
std::optional<std::string> lowerReflectance(glm::dvec3& reflectance, double maxReflectance);

/// Finds the materials for `names` in `files`; the first definition of a name counts. An empty name stands for faces
/// without a material. Throws InputError as parseMaterials, and if a map contains a negative value.
/// - A missing file or name: a warning, and reflectance 0.5 for names that are in no file.
/// - A material without Kd: a warning and 0.5, or, with a map_Kd, the map alone. Without Ke it does not emit, or emits
///   its map_Ke.
/// - The spectrum of a Kd or Ke becomes a colour (see colour.h), whose negative channels become 0 with a warning.
/// - Emissions are converted from `settings.emission` to radiosity.
/// - A reflectance of 1 or more is lowered to `settings.maxReflectance`, with a warning per material. The values of a
///   map_Kd are lowered to 1.
/// - A missing or unreadable map: a warning, and reflectance 0.5 or half the emission.
/// - Kd 0 0 0 with a map_Kd, and Ke 0 0 0 with a map_Ke: a warning, and the map alone, as Maya and 3ds Max mean it.
/// - A map_d is a cut-out: pixels whose alpha is below 0.5 are holes. An image without alpha counts with its mean code.
/// - Faces without a material have the reflectance `unnamed`; if none is given it is 0.5, with a warning.
MaterialSet findMaterials(const std::vector<std::string>& names, const std::vector<std::filesystem::path>& files,
                          const SceneSettings& settings, std::optional<double> unnamed = {});

}  // namespace hemitex::radiosity
