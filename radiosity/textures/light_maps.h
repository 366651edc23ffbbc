/// Light maps: the irradiance of a scene as textures, for programs that multiply them by the colours of materials.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"
#include "radiosity/textures/gltf_scene.h"
#include "radiosity/textures/texture_filter.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

struct LightMaps {
  double exposure = 1;               ///< the factor from W/m^2 to displayed values
  double scale = 1;                  ///< exposed irradiance over linear texel, above 0
  std::vector<CodedImage> textures;  ///< one per texture of the layout
};

/// The light maps of a scene: reflectance x light map x scale, plus emission x exposure, is the display texture of
/// makeLitScene within the codes of both. `irradiance` has one value per element in W/m^2, with the ambient estimate.
/// The scale is the largest exposed irradiance of an element, per band; where less makes an element white, that. Throws
/// InputError as filteredTexture.
LightMaps makeLightMaps(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                        const std::vector<glm::dvec3>& irradiance, double exposure, TextureFilter filter);

/// The same of the irradiance of each texel of each surface, in textures as `linear` ones; the scale is that of texels.
LightMaps makeLightMaps(const Scene& scene, const Discretization& discretization,
                        const std::vector<std::vector<glm::dvec3>>& irradiance, const std::vector<Image>& linear,
                        double exposure);

/// Writes into `folder`, which exists: per texture lightmaps/NAME.png, and lightmaps/NAME.exr, the `linear` one: the
/// irradiance in W/m^2; and lightmap.glb. Of a scene from a glTF file that is the file with coordinates in light maps
/// added (see GltfEditor), or with second ones of its own (see useSecondCoordinates). Else it is the scene with its
/// objects, materials and own texture coordinates, and those in light maps as second ones; emission is in W/m^2. The
/// `extras` of each material name its light map, with scale and exposure. Returns warnings for the user. Throws
/// InputError where a file cannot be written.
std::vector<std::string> writeLightMaps(const std::filesystem::path& folder, LightMaps maps, Scene scene,
                                        const Discretization& discretization, const TextureLayout& layout,
                                        std::vector<Image> linear, const PictureView& view);

}  // namespace hemitex::radiosity
