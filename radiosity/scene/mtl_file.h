/// An MTL file as it is written: what radiosity takes of it, the diffuse reflectance and the emission of materials.
/// Numbers are read and checked here; the options of maps are tinyobjloader's to understand.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// W/m^2 of radiosity. What surfaces make of more, reflecting it for ever, would leave the range of binary32, which
/// images hold.
inline constexpr double largestEmission = 1e30;

/// A `map_Kd` or `map_Ke`.
struct MapStatement {
  std::filesystem::path image;  ///< relative to the material file's folder; empty where the line names none
  bool hasOptions = false;      ///< such as `-s 2 2`
};

/// A material, as far as the file says something about it.
struct MaterialStatement {
  std::string name;
  std::optional<glm::dvec3> reflectance = {};  ///< Kd, finite and not negative
  std::optional<glm::dvec3> emission = {};     ///< Ke as written; as radiosity 0 to largestEmission
  std::optional<MapStatement> reflectanceMap = {};
  std::optional<MapStatement> emissionMap = {};
};

/// Reads the text of `file`, materials in its order. Throws InputError with the line on a malformed, non-finite or
/// negative Kd or Ke, on one that has neither one number (grey) nor three, and on a Ke that is a radiosity above
/// 1e30 where its unit is `unit`.
std::vector<MaterialStatement> parseMaterials(std::string_view text, const std::filesystem::path& file,
                                              EmissionUnit unit = EmissionUnit::Radiosity);

}  // namespace hemitex::radiosity
