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
  bool usesSecondCoordinates = false;  ///< whether its coordinates are those that the file has as TEXCOORD_1
};

/// The affine function with the given values at the corners of a triangle, at a place in its plane.
inline glm::dvec2 affineAt(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec2, 3>& values,
                           const glm::dvec3& place) {
  for (std::size_t k = 0; k < 3; ++k)
    if (corners[k] == place) return values[k];
  const glm::dvec3 a = corners[1] - corners[0], b = corners[2] - corners[0], p = place - corners[0];
  const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), determinant = aa * bb - ab * ab;
  const double s = (glm::dot(p, a) * bb - glm::dot(p, b) * ab) / determinant,
               t = (glm::dot(p, b) * aa - glm::dot(p, a) * ab) / determinant;
  return values[0] + s * (values[1] - values[0]) + t * (values[2] - values[0]);
}

/// What the module exports under the name `hemitexGltfEditor`.
struct GltfEditor {
  /// Makes the bytes of a binary file from those of a .gltf or .glb file that was read from `folder`. A triangle of the
  /// file without a lit one gets the coordinate (0, 0). Returns a problem for a file that is not edited.
  ImportProblem (*edit)(const std::string& bytes, const std::string& folder,
                        const std::vector<GltfLitTriangle>& triangles, const std::vector<NamedLightMap>& maps,
                        std::string& edited);
};

/// Reads the parts of a glTF file again. Returns a problem for a file that has changed since.
ImportProblem readParts(const std::filesystem::path& source, GltfImport& import);

/// Writes `file`, which is `source` with light maps. Returns why the source is not edited, or nothing; then no file is
/// written. Throws InputError if a file cannot be read or written.
std::string writeWithLightMaps(const std::filesystem::path& file, const std::filesystem::path& source,
                               const std::vector<GltfLitTriangle>& triangles, const std::vector<NamedLightMap>& maps);

}  // namespace hemitex::radiosity
