/// Gives a glTF file light maps: its JSON stays as it is, with all that hemitex does not read, such as other maps,
/// animations, lights and unknown extensions. The primitives get coordinates, and the materials names of light maps.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

/// A lit triangle of a file, or a part of it.
struct GltfLitTriangle {
  std::uint32_t polygon = 0;                ///< of the file: the triangles of GltfImport::parts are counted through
  int lightMap = 0;                         ///< in the list of light maps
  std::array<glm::dvec3, 3> positions;      ///< in world space; in reverse order on the back
  std::array<glm::vec2, 3> lightMapCoords;  ///< of the corners; v = 0 is the TOP
};

struct NamedLightMap {
  std::string name;  ///< of its texture
  GltfLightMap map;
};

/// What the module exports under the name `hemitexGltfEditor`.
struct GltfEditor {
  /// Makes the bytes of a binary file from those of a .gltf or .glb file that was read from `folder`. A triangle of the
  /// file without a lit one gets the coordinate (0, 0). Returns a problem for a file that is not edited.
  ImportProblem (*edit)(const std::string& bytes, const std::string& folder,
                        const std::vector<GltfLitTriangle>& triangles, const std::vector<NamedLightMap>& maps,
                        std::string& edited);
};

/// Writes `file`, which is `source` with light maps. Returns why the source is not edited, or nothing; then no file is
/// written. Throws InputError if a file cannot be read or written.
std::string writeWithLightMaps(const std::filesystem::path& file, const std::filesystem::path& source,
                               const std::vector<GltfLitTriangle>& triangles, const std::vector<NamedLightMap>& maps);

}  // namespace hemitex::radiosity
