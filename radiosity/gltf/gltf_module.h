/// The module hemitex_gltf, which is the only code that links tinygltf, and the plain data that it exchanges. Programs
/// open it when they first need it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/images/image.h"

namespace hemitex::radiosity {

// ---- The parts of a glTF 2.0 file that hemitex writes: objects with textures, and a camera --------------------------

struct GltfTexture {
  std::string name;
  std::vector<unsigned char> png;  ///< the bytes of a PNG file, sRGB as glTF requires of base colours
  /// Of coordinates with v = 0 at the bottom.
  Sampler sampler = {.wrap = {Wrap::Clamp, Wrap::Clamp}};
};

/// A light map beside the file, which the `extras` of a material name; see docs/lightmaps.md.
struct GltfLightMap {
  std::string png, exr;  ///< files
  double scale = 1;      ///< by which the linear values of the PNG file are multiplied
  double exposure = 1;   ///< the factor from W/m^2 to displayed values
};

/// A material: unlit, or with a light map, which its primitives then have coordinates of.
struct GltfMaterial {
  std::string name;
  std::optional<int> texture = {};  ///< in GltfModel::textures; scales the colour
  glm::dvec3 colour{1.0};           ///< linear, of the base
  glm::dvec3 emission{0.0};         ///< linear
  std::optional<int> emissionTexture = {};
  std::optional<GltfLightMap> lightMap = {};  ///< without it the material is unlit
  bool isCutOut = false;                      ///< whether the alpha of its texture has holes
};

/// Triangles with one material.
struct GltfPrimitive {
  int material = 0;                            ///< in GltfModel::materials
  std::vector<glm::vec3> positions;            ///< one per vertex, relative to GltfModel::origin
  std::vector<glm::vec2> texcoords;            ///< one per vertex; v = 0 is the TOP of the texture
  std::vector<std::uint32_t> corners;          ///< three vertices per triangle, counter-clockwise seen from the front
  std::vector<glm::vec2> lightMapCoords = {};  ///< TEXCOORD_1: one per vertex, as `texcoords`; or empty
  std::vector<glm::vec3> colours = {};         ///< COLOR_0: one per vertex; or empty
};

/// A node. Without primitives it has no mesh.
struct GltfObject {
  std::string name;
  std::optional<int> parent = {};  ///< in GltfModel::objects, before or behind
  std::vector<GltfPrimitive> primitives;
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
  /// From scene coordinates to those of glTF, which are metres with +y upwards: a node above all others, unless it is
  /// the identity.
  glm::dmat4 toGltf{1.0};
  glm::dvec3 origin{0.0};  ///< translation of the roots, so that scenes far from zero lose no digits in binary32
  std::vector<GltfTexture> textures;
  std::vector<GltfMaterial> materials;
  std::vector<GltfObject> objects;
  GltfCamera camera;
};

// ---- The parts of a glTF 2.0 file that hemitex reads: triangles in world space, materials, images and the camera ----

struct ImportedMaterial {
  std::string name;                                     ///< unique and not empty
  std::optional<glm::dvec3> baseColor = {};             ///< linear, as the file states it
  std::optional<int> baseColorImage = {};               ///< in GltfImport::images
  Sampler baseColorSampler = {}, emissionSampler = {};  ///< of scene coordinates, with v = 0 at the bottom
  int texcoords = 0;                                    ///< the set of texture coordinates that its textures use
  glm::dvec3 emission{0.0};                             ///< the emissive factor times the emissive strength
  std::optional<int> emissionImage = {};                ///< in GltfImport::images
  double alpha = 1;                                     ///< the factor of alpha
  std::optional<double> cutoff = {};                    ///< of alphaMode MASK
  bool isDoubleSided = false;
  std::string transparency = {};  ///< what lets light through, such as `BLEND`; empty if nothing does
};

struct ImportedImage {
  std::string name;                  ///< for messages; not empty
  std::vector<unsigned char> bytes;  ///< of a PNG, JPEG or WebP file; empty if the file is missing
};

/// A node, with a mesh or without.
struct ImportedNode {
  std::string name;                ///< its own, or that of its mesh; not empty, and unique among nodes with a mesh
  std::optional<int> parent = {};  ///< in GltfImport::nodes
};

/// The triangles of a mesh in a node that share a material.
struct ImportedPart {
  int node = 0;                          ///< in GltfImport::nodes
  std::optional<int> material = {};      ///< in GltfImport::materials
  std::vector<glm::dvec3> positions;     ///< one per vertex, in world space
  std::vector<glm::dvec2> texcoords;     ///< one per vertex, or empty; v = 0 is the TOP of an image
  std::vector<glm::dvec2> secondCoords;  ///< TEXCOORD_1, as `texcoords`
  std::vector<glm::dvec3> colours;       ///< linear, one per vertex, or empty
  std::vector<glm::dvec3> normals;       ///< one per vertex, in world space, of any length; or empty
  std::vector<std::uint32_t> corners;    ///< three vertices per triangle, counter-clockwise seen from the front
};

struct ImportedCamera {
  glm::dvec3 eye{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov = 50;  ///< vertical, in degrees
};

/// A light of KHR_lights_punctual at a node.
struct ImportedLight {
  enum class Kind { Point, Spot, Directional };
  Kind kind = Kind::Point;
  std::string name;                       ///< of its node, or its own
  glm::dvec3 position{0.0};               ///< in world space
  glm::dvec3 direction{0.0, 0.0, -1.0};   ///< unit vector along the light, in world space
  glm::dvec3 intensity{0.0};              ///< linear colour times cd; of directional light times lux; >= 0
  double innerAngle = 0, outerAngle = 0;  ///< of a spot, to its axis, in radians; 0 <= inner <= outer <= pi/2
};

struct GltfImport {
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedImage> images;     ///< one per file or range of bytes, however many images of the file name it
  std::vector<ImportedNode> nodes;       ///< in the order of a walk from the roots of the scene, children after parents
  std::vector<ImportedPart> parts;       ///< in the order of the nodes
  std::optional<ImportedCamera> camera;  ///< the first one with a perspective
  std::vector<ImportedLight> lights;     ///< in the order of the nodes
  std::vector<std::string> warnings;     ///< one sentence each, for the user
  std::vector<std::string> files;        ///< buffers and images that were read, with the folder of the scene
};

/// Why a file was not read, and what to do about it; both are empty when it was.
struct ImportProblem {
  std::string problem;
  std::string advice;
};

// ---- Functions -----------------------------------------------------------------------------------------------------

/// What the module exports under the name `hemitexGltfWriter`.
struct GltfWriter {
  /// Writes a model as binary glTF (.glb). Equal models give equal bytes. The caller checks the stream.
  void (*write)(GltfModel model, std::ostream& stream);
};

/// Asks for memory before it is taken, and throws if it is not there.
struct ImportBudget {
  std::function<void(std::uint64_t bytes, const std::string& file)> forFile;
  /// For the triangles of all nodes together, and the vertices of their meshes.
  std::function<void(std::uint64_t triangles, std::uint64_t vertices)> forMeshes;
};

/// What the module exports under the name `hemitexGltfReader`.
struct GltfReader {
  /// Reads the bytes of a .gltf or .glb file. Files that it names are read from `folder` and below, never from
  /// elsewhere. Throws nothing but std::bad_alloc and what `budget` throws.
  ImportProblem (*read)(const std::string& bytes, const std::string& folder, const ImportBudget& budget,
                        GltfImport& import);
};

/// Opens the module at the first call. Throws std::runtime_error where it is not found.
const GltfReader& gltfReader();

/// Writes a model as binary glTF (.glb); equal models give equal files. The format counts bytes in 32 bits. A model
/// that may need more than `maxBytes` is not written; then returns a warning for the user. Uses memory for two copies
/// of the file. Throws InputError if the file cannot be written.
std::optional<std::string> writeGlb(const std::filesystem::path& file, GltfModel model,
                                    std::uint64_t maxBytes = std::numeric_limits<std::uint32_t>::max());

}  // namespace hemitex::radiosity
