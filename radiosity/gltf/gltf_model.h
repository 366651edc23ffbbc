/// The parts of a glTF 2.0 file that hemitex writes: unlit objects with textures, and a camera. Plain data, which the
/// module hemitex_gltf encodes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hemitex::radiosity {

struct GltfTexture {
  std::string name;
  std::vector<unsigned char> png;  ///< the bytes of a PNG file, sRGB as glTF requires of base colours
};

/// An unlit material: a texture, or white.
struct GltfMaterial {
  std::string name;
  std::optional<int> texture = {};  ///< in GltfModel::textures
};

/// A mesh of triangles in a node of its own.
struct GltfObject {
  std::string name;
  int material = 0;                    ///< in GltfModel::materials
  std::vector<glm::vec3> positions;    ///< one per vertex, relative to GltfModel::origin
  std::vector<glm::vec2> texcoords;    ///< one per vertex; v = 0 is the TOP of the texture
  std::vector<glm::vec3> colours;      ///< one per vertex, linear, scales the texture; or empty
  std::vector<std::uint32_t> corners;  ///< three vertices per triangle, counter-clockwise seen from the front
};

struct GltfCamera {
  glm::dmat4 toWorld{
      1.0};           ///< from the camera, which looks along -z with y upwards, to positions relative to the origin
  double fov = 1;     ///< vertical, in radians, in (0, pi)
  double aspect = 1;  ///< width over height
  double near = 1;    ///< distances of the near and far planes, 0 < near < far
  double far = 2;
};

struct GltfModel {
  glm::dvec3 origin{0.0};  ///< translation of all nodes, so that scenes far from zero lose no digits in binary32
  std::vector<GltfTexture> textures;
  std::vector<GltfMaterial> materials;
  std::vector<GltfObject> objects;
  GltfCamera camera;
};

}  // namespace hemitex::radiosity
