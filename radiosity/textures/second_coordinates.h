/// Light maps in the second texture coordinates of a glTF file (TEXCOORD_1), where these are a chart: tools that make
/// scenes for light maps lay them out so. Elsewhere light maps have coordinates of their own (see light_maps.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/gltf/gltf_light_maps.h"
#include "radiosity/images/image.h"

namespace hemitex::radiosity {

/// The light maps of a file and what lies in them: `maps`, `textures` and `linear` have one entry per light map.
struct FileLightMaps {
  std::vector<GltfLitTriangle> triangles;
  std::vector<NamedLightMap> maps;
  std::vector<CodedImage> textures;  ///< of maps[i].map.png
  std::vector<Image> linear;         ///< of maps[i].map.exr, in W/m^2; of any size
};

/// Gives each part of a glTF file whose second coordinates are a chart a light map in these coordinates, behind the
/// others, of which some then show nothing. It has about the texels of the old ones, which it interpolates, and
/// continues them around the triangles for two texels. Returns a sentence for each other part with second coordinates,
/// which says why they are not used. Changes nothing if the file cannot be read.
std::vector<std::string> useSecondCoordinates(const std::filesystem::path& file, FileLightMaps& lit);

}  // namespace hemitex::radiosity
