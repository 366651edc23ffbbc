/// Reads a glTF 2.0 file (.gltf or .glb): polygons, materials and the camera.
///
/// - A node with a mesh is a group. Its name is that of the group, its transform is applied to the positions.
/// - The reflectance is the base colour, factor times texture. Metallic and rough surfaces reflect diffusely like all
///   others: a metal reflects its base colour, too, so that the reflected flux is right. Alpha is ignored, with a
///   warning.
/// - The emission is the emissive factor times KHR_materials_emissive_strength times the emissive texture. glTF states
///   a luminance in nits. Its number is read as Ke of an MTL file is: as radiosity, or as radiance where the settings
///   say so.
/// - Point and spot lights (KHR_lights_punctual) are lamps, directional ones suns. Their candela and lux are divided by
///   SceneSettings::lumensPerWatt.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/gltf/gltf_module.h"
#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/materials.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

struct GltfFile {
  PolygonMesh mesh;  ///< all triangles
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedImage> images;
  std::vector<ImportedLight> lights;
  std::optional<SceneCamera> camera;
  std::vector<std::filesystem::path> files;  ///< buffers and images that were read
};

/// Reads a file. Throws InputError if it cannot be read, is malformed, names files outside its folder, or has an index
/// out of range, a number that is not finite or an absolute coordinate above 1e18.
GltfFile readGltf(const std::filesystem::path& file);

/// The materials for `names`; an empty name stands for faces without a material, which get the
/// reflectance 0.8 with a warning.
/// Values are made valid as by findMaterials. Throws InputError for an emission above 1e30.
MaterialSet gltfMaterials(const std::vector<std::string>& names, const GltfFile& gltf,
                          const std::filesystem::path& file, const SceneSettings& settings);

/// Adds the lamps and suns of a file to a scene. A lamp has the name of its node, with `~2`, ... where it is repeated.
/// Throws InputError for an intensity above 1e30.
void addLights(Scene& scene, const std::vector<ImportedLight>& lights, const std::filesystem::path& file,
               const SceneSettings& settings);

}  // namespace hemitex::radiosity
