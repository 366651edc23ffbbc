/// The parts of a glTF 2.0 file that radiosity uses, as plain data: triangles in world space, materials, images and the
/// camera. The module hemitex_gltf fills them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hemitex::radiosity {

struct ImportedMaterial {
  std::string name;                        ///< unique and not empty
  glm::dvec3 baseColor{1.0};               ///< linear, as the file states it
  std::optional<int> baseColorImage = {};  ///< in GltfImport::images
  glm::dvec3 emission{0.0};                ///< the emissive factor times the emissive strength
  std::optional<int> emissionImage = {};   ///< in GltfImport::images
};

struct ImportedImage {
  std::string name;                  ///< for messages; not empty
  std::vector<unsigned char> bytes;  ///< of a PNG or JPEG file; empty if the file is missing
};

/// The triangles of a mesh in a node that share a material.
struct ImportedPart {
  std::string node;                    ///< its name, or that of its mesh; unique per node and not empty
  std::optional<int> material = {};    ///< in GltfImport::materials
  std::vector<glm::dvec3> positions;   ///< one per vertex, in world space
  std::vector<glm::dvec2> texcoords;   ///< one per vertex, or empty; v = 0 is the TOP of an image
  std::vector<std::uint32_t> corners;  ///< three vertices per triangle, counter-clockwise seen from the front
};

struct ImportedCamera {
  glm::dvec3 eye{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov = 50;  ///< vertical, in degrees
};

struct GltfImport {
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedImage> images;
  std::vector<ImportedPart> parts;       ///< in the order of a walk from the roots of the scene, children after parents
  std::optional<ImportedCamera> camera;  ///< the first one with a perspective
  std::vector<std::string> warnings;     ///< one sentence each, for the user
  std::vector<std::string> files;        ///< buffers and images that were read, with the folder of the scene
};

/// Why a file was not read, and what to do about it; both are empty when it was.
struct ImportProblem {
  std::string problem;
  std::string advice;
};

}  // namespace hemitex::radiosity
