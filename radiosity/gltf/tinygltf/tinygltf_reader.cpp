/// The module hemitex_gltf: reads glTF by tinygltf. tinygltf parses the file; this code checks every index, range
/// and number that it returns.
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "radiosity/base/unique_names.h"
#include "radiosity/gltf/gltf_module.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "the buffers of glTF are little-endian");

using Fault = ImportProblem;

constexpr const char* exportAgain = "export the scene again";

std::string numbered(const std::string& what, std::size_t index) { return what + " " + std::to_string(index); }

template <typename Item>
const Item& itemAt(const std::vector<Item>& items, int index, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= items.size())
    throw Fault{what + " " + std::to_string(index) + " does not exist: there are " + std::to_string(items.size()),
                exportAgain};
  return items[static_cast<std::size_t>(index)];
}

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// ---- Buffers -------------------------------------------------------------------------------------------------------

/// Bytes of a buffer.
struct Bytes {
  const unsigned char* first = nullptr;
  std::size_t size = 0;
};

Bytes bytesOf(const tinygltf::Model& gltf, int viewIndex) {
  const tinygltf::BufferView& view = itemAt(gltf.bufferViews, viewIndex, "buffer view");
  const std::vector<unsigned char>& data = itemAt(gltf.buffers, view.buffer, "buffer").data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    throw Fault{"buffer view " + std::to_string(viewIndex) + " reaches beyond its buffer", exportAgain};
  return {data.data() + view.byteOffset, view.byteLength};
}

/// The largest value of a normalized integer stands for 1.
template <typename Component>
double valueAt(const unsigned char* bytes, bool isNormalized) {
  Component value;
  std::memcpy(&value, bytes, sizeof value);
  if (!isNormalized) return static_cast<double>(value);
  constexpr bool isScaled = std::is_integral_v<Component> && sizeof value < 4;
  return std::max(
      static_cast<double>(value) / (isScaled ? static_cast<double>(std::numeric_limits<Component>::max()) : 1), -1.0);
}

double componentAt(const unsigned char* bytes, int type, bool isNormalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return valueAt<std::int8_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return valueAt<std::uint8_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return valueAt<std::int16_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return valueAt<std::uint16_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return valueAt<std::uint32_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return valueAt<float>(bytes, isNormalized);
    default:
      throw Fault{"the component type " + std::to_string(type) + " is unknown", exportAgain};
  }
}

/// The values of an accessor, `components` per element.
std::vector<double> valuesOf(const tinygltf::Model& gltf, int index, int type, int components) {
  const tinygltf::Accessor& accessor = itemAt(gltf.accessors, index, "accessor");
  const std::string name = "accessor " + std::to_string(index);
  if (accessor.sparse.isSparse) throw Fault{name + " is sparse, which is not read", "export without sparse accessors"};
  if (accessor.type != type) throw Fault{name + " has values of a wrong type", exportAgain};
  const std::int32_t componentSize =
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  componentAt(std::array<unsigned char, 8>{}.data(), accessor.componentType, false);  // throws for an unknown type
  const auto componentBytes = static_cast<std::size_t>(componentSize);
  const std::size_t size = componentBytes * static_cast<std::size_t>(components);
  if (accessor.count == 0) return {};
  const Bytes bytes = bytesOf(gltf, accessor.bufferView);
  const std::size_t given = gltf.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  const std::size_t stride = given == 0 ? size : given;
  if (stride < size) throw Fault{name + " has a stride below the size of its values", exportAgain};
  // Divided, because products of numbers in the file may overflow.
  if (accessor.byteOffset > bytes.size || size > bytes.size - accessor.byteOffset ||
      accessor.count - 1 > (bytes.size - accessor.byteOffset - size) / stride)
    throw Fault{name + " reaches beyond its buffer view", exportAgain};
  std::vector<double> values;
  values.reserve(accessor.count * static_cast<std::size_t>(components));
  for (std::size_t i = 0; i < accessor.count; ++i)
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
      const unsigned char* const first = bytes.first + accessor.byteOffset + i * stride + c * componentBytes;
      values.push_back(componentAt(first, accessor.componentType, accessor.normalized));
    }
  return values;
}

// ---- Meshes --------------------------------------------------------------------------------------------------------

std::vector<glm::dvec3> positionsOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                    const glm::dmat4& toWorld) {
  const auto found = primitive.attributes.find("POSITION");
  if (found == primitive.attributes.end()) return {};
  const std::vector<double> values = valuesOf(gltf, found->second, TINYGLTF_TYPE_VEC3, 3);
  std::vector<glm::dvec3> positions;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    positions.emplace_back(toWorld * glm::dvec4(values[i], values[i + 1], values[i + 2], 1));
    if (!isFinite(positions.back()))
      throw Fault{numbered("vertex", i / 3) + " has a coordinate that is not finite", exportAgain};
  }
  return positions;
}

std::vector<glm::dvec2> texcoordsOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                    std::size_t vertices) {
  const auto found = primitive.attributes.find("TEXCOORD_0");
  if (found == primitive.attributes.end()) return {};
  const std::vector<double> values = valuesOf(gltf, found->second, TINYGLTF_TYPE_VEC2, 2);
  if (values.size() != 2 * vertices) throw Fault{"positions and texture coordinates differ in number", exportAgain};
  std::vector<glm::dvec2> texcoords;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    if (!std::isfinite(values[i]) || !std::isfinite(values[i + 1]))
      throw Fault{numbered("vertex", i / 2) + " has a texture coordinate that is not finite", exportAgain};
    texcoords.emplace_back(values[i], values[i + 1]);
  }
  return texcoords;
}

/// Empty if the normals are missing or faulty, since a scene is complete without them.
std::vector<glm::dvec3> normalsOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                  std::size_t vertices, const glm::dmat4& toWorld) {
  const auto found = primitive.attributes.find("NORMAL");
  const glm::dmat3 linear(toWorld);
  if (found == primitive.attributes.end() || glm::determinant(linear) == 0) return {};
  const glm::dmat3 ofNormals = glm::transpose(glm::inverse(linear));
  std::vector<glm::dvec3> normals;
  try {
    const std::vector<double> values = valuesOf(gltf, found->second, TINYGLTF_TYPE_VEC3, 3);
    for (std::size_t i = 0; i < values.size(); i += 3)
      normals.push_back(ofNormals * glm::dvec3(values[i], values[i + 1], values[i + 2]));
  } catch (const Fault&) {
    return {};
  }
  if (normals.size() != vertices || !std::all_of(normals.begin(), normals.end(), isFinite)) return {};
  return normals;
}

/// The vertices of a primitive in the order in which it uses them.
std::vector<std::uint32_t> verticesOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                      std::size_t vertices) {
  std::vector<std::uint32_t> used;
  if (primitive.indices < 0) {
    for (std::size_t v = 0; v < vertices; ++v) used.push_back(static_cast<std::uint32_t>(v));
    return used;
  }
  const int type = itemAt(gltf.accessors, primitive.indices, "accessor").componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    throw Fault{"indices have the component type " + std::to_string(type), exportAgain};
  for (const double index : valuesOf(gltf, primitive.indices, TINYGLTF_TYPE_SCALAR, 1)) {
    if (index >= static_cast<double>(vertices))
      throw Fault{"index " + std::to_string(static_cast<std::uint32_t>(index)) + " is out of range: there are " +
                      std::to_string(vertices) + " vertices",
                  exportAgain};
    used.push_back(static_cast<std::uint32_t>(index));
  }
  return used;
}

/// Three vertices per triangle, in the order of the specification (section 3.7.2.1).
std::vector<std::uint32_t> cornersOf(const std::vector<std::uint32_t>& used, int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (used.size() % 3 != 0)
      throw Fault{"triangles have " + std::to_string(used.size()) + " corners, which is no multiple of 3", exportAgain};
    return used;
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i + 2 < used.size(); ++i) {
    const std::size_t odd = i % 2;
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      corners.insert(corners.end(), {used[i], used[i + 1 + odd], used[i + 2 - odd]});
    else
      corners.insert(corners.end(), {used[i + 1], used[i + 2], used[0]});
  }
  return corners;
}

// ---- Nodes ---------------------------------------------------------------------------------------------------------

glm::dmat4 localMatrix(const tinygltf::Node& node) {
  glm::dmat4 matrix(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return matrix;
  }
  if (node.rotation.size() == 4) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(length > 0)) throw Fault{"the rotation of node `" + node.name + "` is zero", exportAgain};
    matrix = glm::mat4_cast(rotation / length);
  }
  if (node.scale.size() == 3)
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
  if (node.translation.size() == 3)
    matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
  return matrix;
}

/// The number of values of an accessor. Where they are not in the file, which is reported when they are read, the
/// number of its bytes or 0.
std::uint64_t countOf(const tinygltf::Model& gltf, int index) try {
  const tinygltf::Accessor& accessor = itemAt(gltf.accessors, index, "accessor");
  return std::min<std::uint64_t>(accessor.count, bytesOf(gltf, accessor.bufferView).size);
} catch (const Fault&) {
  return 0;
}

bool isOfTriangles(const tinygltf::Primitive& primitive) {
  return primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

/// What a mesh becomes in one node.
struct MeshSize {
  std::uint64_t triangles = 0, vertices = 0;
};

MeshSize sizeOf(const tinygltf::Model& gltf, const tinygltf::Mesh& mesh) {
  MeshSize size;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const auto positions = primitive.attributes.find("POSITION");
    if (!isOfTriangles(primitive) || positions == primitive.attributes.end()) continue;
    const std::uint64_t vertices = countOf(gltf, positions->second),
                        corners = primitive.indices < 0 ? vertices : countOf(gltf, primitive.indices);
    size.vertices += vertices;
    size.triangles += primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : corners;
  }
  return size;
}

/// Collects the meshes and the camera of the nodes of a scene.
class NodeReader {
 public:
  NodeReader(const tinygltf::Model& gltf, GltfImport& import)
      : gltf_(gltf), import_(import), isVisited_(gltf.nodes.size()) {}

  /// Reads the node and all below it, but no mesh. A stack, because a file may nest nodes deeper than calls may be.
  void readTree(int root) {
    struct Open {
      int index = 0;
      std::optional<int> parent = {};  // in the import
      glm::dmat4 parentToWorld{1.0};
    };
    std::vector<Open> open = {{root}};
    while (!open.empty()) {
      const auto [index, parent, parentToWorld] = open.back();
      open.pop_back();
      const tinygltf::Node& node = itemAt(gltf_.nodes, index, "node");
      if (isVisited_[static_cast<std::size_t>(index)])
        throw Fault{numbered("node", static_cast<std::size_t>(index)) + " has several parents", exportAgain};
      isVisited_[static_cast<std::size_t>(index)] = true;
      const glm::dmat4 toWorld = parentToWorld * localMatrix(node);
      const auto number = static_cast<int>(import_.nodes.size());
      import_.nodes.push_back({node.name.empty() ? "node-" + std::to_string(index) : node.name, parent});
      if (node.mesh >= 0) instances_.push_back({index, number, toWorld});
      if (node.camera >= 0) readCamera(node, toWorld);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, number, toWorld});
    }
  }

  /// Reads the meshes of all nodes. They are counted first, because a small file may repeat a mesh many times.
  void readMeshes(const ImportBudget& budget) {
    std::vector<MeshSize> ofMesh;
    for (const tinygltf::Mesh& mesh : gltf_.meshes) ofMesh.push_back(sizeOf(gltf_, mesh));
    MeshSize all;
    for (const Instance& instance : instances_) {
      const MeshSize& size = itemAt(ofMesh, gltf_.nodes[static_cast<std::size_t>(instance.node)].mesh, "mesh");
      all.triangles += size.triangles;
      all.vertices += size.vertices;
    }
    budget.forMeshes(all.triangles, all.vertices);
    for (const Instance& instance : instances_) readMesh(instance);
    if (otherPrimitives_ > 0)
      import_.warnings.push_back(numbered("points and lines are left out; primitives:", otherPrimitives_));
  }

 private:
  /// A node with a mesh.
  struct Instance {
    int node = 0;      // of the file
    int imported = 0;  // in the import
    glm::dmat4 toWorld{1.0};
  };

  void readMesh(const Instance& instance) {
    const tinygltf::Node& node = gltf_.nodes[static_cast<std::size_t>(instance.node)];
    const tinygltf::Mesh& mesh = gltf_.meshes[static_cast<std::size_t>(node.mesh)];
    std::string name = node.name.empty() ? mesh.name : node.name;
    if (name.empty()) name = "node-" + std::to_string(instance.node);
    name = names_.add(name);
    import_.nodes[static_cast<std::size_t>(instance.imported)].name = name;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      try {
        readPrimitive(primitive, instance);
      } catch (const Fault& fault) {
        throw Fault{"the mesh of node `" + name + "`: " + fault.problem, fault.advice};
      }
    }
  }

  void readPrimitive(const tinygltf::Primitive& primitive, const Instance& instance) {
    const glm::dmat4& toWorld = instance.toWorld;
    if (!isOfTriangles(primitive)) {
      ++otherPrimitives_;
      return;
    }
    ImportedPart part;
    part.node = instance.imported;
    if (primitive.material >= 0) {
      itemAt(gltf_.materials, primitive.material, "material");
      part.material = primitive.material;
    }
    part.positions = positionsOf(gltf_, primitive, toWorld);
    part.texcoords = texcoordsOf(gltf_, primitive, part.positions.size());
    part.normals = normalsOf(gltf_, primitive, part.positions.size(), toWorld);
    part.corners = cornersOf(verticesOf(gltf_, primitive, part.positions.size()), primitive.mode);
    // A mirror turns clockwise triangles into counter-clockwise ones.
    if (glm::determinant(glm::dmat3(toWorld)) < 0)
      for (std::size_t c = 0; c < part.corners.size(); c += 3) std::swap(part.corners[c + 1], part.corners[c + 2]);
    import_.parts.push_back(std::move(part));
  }

  void readCamera(const tinygltf::Node& node, const glm::dmat4& toWorld) {
    const tinygltf::Camera& camera = itemAt(gltf_.cameras, node.camera, "camera");
    const double fov = camera.perspective.yfov;
    if (import_.camera || camera.type != "perspective" || !(fov > 0 && fov < std::numbers::pi)) return;
    const ImportedCamera seen{
        .eye = toWorld[3], .direction = -glm::dvec3(toWorld[2]), .up = toWorld[1], .fov = fov * 180 / std::numbers::pi};
    const double area = glm::length(glm::cross(seen.direction, seen.up));
    if (!isFinite(seen.eye) || !(area > 0) || !std::isfinite(area)) return;
    import_.camera = seen;
  }

  const tinygltf::Model& gltf_;
  GltfImport& import_;
  std::vector<bool> isVisited_;
  std::vector<Instance> instances_;  // in the order of the walk
  UniqueNames names_;
  std::size_t otherPrimitives_ = 0;
};

/// The nodes that a scene begins with: those of the default scene, of the first scene, or all without a parent.
std::vector<int> rootsOf(const tinygltf::Model& gltf) {
  if (!gltf.scenes.empty()) return itemAt(gltf.scenes, std::max(gltf.defaultScene, 0), "scene").nodes;
  std::set<int> children;
  for (const tinygltf::Node& node : gltf.nodes) children.insert(node.children.begin(), node.children.end());
  std::vector<int> roots;
  for (int n = 0; n < static_cast<int>(gltf.nodes.size()); ++n)
    if (children.count(n) == 0) roots.push_back(n);
  return roots;
}

// ---- Materials -----------------------------------------------------------------------------------------------------

/// A factor of three numbers of at least 0; `missing` where the file has none.
glm::dvec3 factorOf(const std::vector<double>& numbers, const glm::dvec3& missing, const std::string& what) {
  if (numbers.size() < 3) return missing;
  const glm::dvec3 factor(numbers[0], numbers[1], numbers[2]);
  if (!isFinite(factor)) throw Fault{"a factor of " + what + " is not finite", exportAgain};
  if (factor.x < 0 || factor.y < 0 || factor.z < 0)
    throw Fault{"a factor of " + what + " is negative", "light cannot be less than 0"};
  return factor;
}

double emissiveStrength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  if (extension == material.extensions.end() || !extension->second.IsObject() ||
      !extension->second.Has("emissiveStrength"))
    return 1;
  const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
  return strength.IsNumber() ? strength.GetNumberAsDouble() : 1;
}

/// The image of a texture in the import, if there is one.
std::optional<int> imageOf(const tinygltf::Model& gltf, const std::vector<int>& images, int texture, int texcoord,
                           const std::string& material, GltfImport& import) {
  if (texture < 0) return {};
  const int image = itemAt(images, itemAt(gltf.textures, texture, "texture").source, "image");
  if (texcoord != 0)
    import.warnings.push_back("material '" + material + "': its texture uses other coordinates than the first ones");
  return image;
}

/// What lets light through a material: transmission, or alpha where the mode uses it. A factor of 0 transmits nothing.
std::string transparencyOf(const tinygltf::Material& material) {
  const auto transmission = material.extensions.find("KHR_materials_transmission");
  if (transmission != material.extensions.end() && transmission->second.IsObject() &&
      transmission->second.Has("transmissionFactor")) {
    const tinygltf::Value& factor = transmission->second.Get("transmissionFactor");
    if (factor.IsNumber() && factor.GetNumberAsDouble() > 0) return "KHR_materials_transmission";
  }
  return material.alphaMode == "BLEND" || material.alphaMode == "MASK" ? "alphaMode " + material.alphaMode : "";
}

/// `images` has the number in the import of each image of the file.
std::vector<ImportedMaterial> materialsOf(const tinygltf::Model& gltf, const std::vector<int>& images,
                                          GltfImport& import) {
  std::vector<ImportedMaterial> materials;
  UniqueNames names;
  for (std::size_t m = 0; m < gltf.materials.size(); ++m) {
    const tinygltf::Material& given = gltf.materials[m];
    ImportedMaterial material;
    material.name = names.add(given.name.empty() ? "material-" + std::to_string(m) : given.name);
    const std::string owner = "material '" + material.name + "'";
    const tinygltf::PbrMetallicRoughness& pbr = given.pbrMetallicRoughness;
    material.baseColor = factorOf(pbr.baseColorFactor, glm::dvec3(1.0), owner);
    material.baseColorImage =
        imageOf(gltf, images, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, material.name, import);
    const double strength = emissiveStrength(given);
    material.emission = factorOf(given.emissiveFactor, glm::dvec3(0.0), owner);
    material.emission =
        factorOf({material.emission.x * strength, material.emission.y * strength, material.emission.z * strength},
                 glm::dvec3(0.0), owner);
    material.emissionImage =
        imageOf(gltf, images, given.emissiveTexture.index, given.emissiveTexture.texCoord, material.name, import);
    material.transparency = transparencyOf(given);
    materials.push_back(std::move(material));
  }
  return materials;
}

/// The number of a key, `next` if it is new; and whether it is.
template <typename Key>
std::pair<int, bool> numberOf(std::map<Key, int>& numbers, const Key& key, int next) {
  const auto [known, isNew] = numbers.try_emplace(key, next);
  return {known->second, isNew};
}

/// Adds the images to the import, those of one source once. Returns the number in the import of each.
std::vector<int> readImages(const tinygltf::Model& gltf, GltfImport& import) {
  std::vector<int> numbers;
  std::map<std::string, int> ofFile;
  std::map<std::pair<const unsigned char*, std::size_t>, int> ofRange;
  for (std::size_t i = 0; i < gltf.images.size(); ++i) {
    const tinygltf::Image& given = gltf.images[i];
    Bytes bytes{given.image.data(), given.image.size()};
    if (given.bufferView >= 0) bytes = bytesOf(gltf, given.bufferView);
    const auto next = static_cast<int>(import.images.size());
    const bool isFile = given.bufferView < 0 && !given.uri.empty();
    const auto [number, isNew] =
        isFile ? numberOf(ofFile, given.uri, next) : numberOf(ofRange, std::pair(bytes.first, bytes.size), next);
    numbers.push_back(number);
    if (isNew)
      import.images.push_back({given.uri.empty() ? "image " + std::to_string(i) : given.uri,
                               { bytes.first,
                                 bytes.first + bytes.size }});
  }
  return numbers;
}

// ---- Files ---------------------------------------------------------------------------------------------------------

/// The folder of the scene, and the files in it that were read.
struct SceneFolder {
  const std::string& name;
  const ImportBudget& budget;
  std::vector<std::string>& read;
  std::set<std::string> images = {};  ///< whose bytes are kept
  std::string asked = {};             ///< the last file that was looked for
};

/// Keeps the bytes of an image from a file, once per file, or a data URI. Those of buffer views are read later, after a
/// check of their range, which tinygltf omits.
bool keepImage(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
               void* folder) {
  if (image->bufferView >= 0) return true;
  if (image->uri.empty() || static_cast<SceneFolder*>(folder)->images.insert(image->uri).second)
    image->image.assign(bytes, bytes + size);
  return true;
}

/// Whether a name leads to a file in the folder of the scene or below it.
bool isInside(const std::string& name, const std::string& folder) {
  if (!name.starts_with(folder + "/")) return false;
  const std::filesystem::path rest = std::filesystem::path(name.substr(folder.size() + 1)).lexically_normal();
  return rest.is_relative() && rest != "." && (rest.empty() || *rest.begin() != "..");
}

bool fileExists(const std::string& name, void* folder) {
  std::error_code ignored;
  auto* const scene = static_cast<SceneFolder*>(folder);
  scene->asked = name;
  return isInside(name, scene->name) && std::filesystem::is_regular_file(name, ignored);
}

bool readWholeFile(std::vector<unsigned char>* bytes, std::string* problem, const std::string& name, void* folder) {
  auto& [ignored, budget, read, images, asked] = *static_cast<SceneFolder*>(folder);
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(name, unknown);
  budget.forFile(unknown ? 0 : size, name);
  read.push_back(name);
  std::ifstream file(name, std::ios::binary);
  bytes->assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (!file.eof() && !file) *problem = "it cannot be read";
  return problem->empty();
}

/// tinygltf expands names as a shell does; names in a scene are names.
std::string sameName(const std::string& name, void*) { return name; }

/// The fault of a file, from tinygltf's message.
Fault faultOf(const std::string& message, const SceneFolder& folder) {
  if (message.starts_with("File not found")) {
    const std::string name = std::filesystem::path(folder.asked).filename().string();
    return {"names the file `" + name + "`, which is not in its folder or below", "put it there"};
  }
  const std::size_t place = message.find("line ");
  if (message.starts_with("[json.") && place != std::string::npos)
    return {"is not JSON: " + message.substr(place, message.find(':', place) - place), exportAgain};
  return {"is no valid glTF", "give a glTF 2.0 file"};
}

/// Throws Fault for a file whose meshes are compressed, before tinygltf misses the buffers that they replace.
void refuseCompression(const std::string& bytes) {
  const std::size_t start = std::min(bytes.find("\"extensionsRequired\""), bytes.size());
  const std::string required = bytes.substr(start, bytes.find(']', start) - start);
  if (required.find("\"KHR_draco_mesh_compression\"") != std::string::npos)
    throw Fault{"is compressed with Draco (KHR_draco_mesh_compression), which is not read",
                "export it without compression (in Blender's glTF export: Data, Compression off)"};
  if (required.find("\"EXT_meshopt_compression\"") != std::string::npos)
    throw Fault{"is compressed with meshopt (EXT_meshopt_compression), which is not read",
                "export it without compression (gltfpack: without -c and -cc)"};
}

tinygltf::Model parse(const std::string& bytes, SceneFolder& folder) {
  if (bytes.size() > std::numeric_limits<unsigned int>::max())
    throw Fault{"the file has more than 4 GiB", "divide the scene"};
  refuseCompression(bytes);
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(keepImage, &folder);
  reader.SetFsCallbacks({fileExists, sameName, readWholeFile, nullptr, &folder});
  tinygltf::Model gltf;
  std::string error, warning;  // it warns of missing images, which have no bytes
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool isRead =
      bytes.starts_with("glTF")
          ? reader.LoadBinaryFromMemory(&gltf, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                        size, folder.name)
          : reader.LoadASCIIFromString(&gltf, &error, &warning, bytes.data(), size, folder.name);
  if (!isRead || !error.empty()) throw faultOf(error, folder);
  return gltf;
}

/// Throws Fault for an extension without which the file cannot be understood.
void checkExtensions(const tinygltf::Model& gltf) {
  for (const std::string& name : gltf.extensionsRequired) {
    const bool isRead = name.starts_with("KHR_materials_") || name == "KHR_mesh_quantization" ||
                        name == "KHR_lights_punctual" || name == "KHR_texture_transform";
    if (!isRead) throw Fault{"needs the extension " + name + ", which is not read", "export without this extension"};
  }
}

void warnOfOmissions(const tinygltf::Model& gltf, GltfImport& import) {
  if (!gltf.lights.empty())
    import.warnings.push_back("point, spot and directional lights are left out (" + std::to_string(gltf.lights.size()) +
                              "); light comes from emissive materials");
  if (!gltf.skins.empty() || !gltf.animations.empty()) import.warnings.push_back("skins and animations are left out");
  for (const std::string& name : gltf.extensionsUsed) {
    if (name == "KHR_texture_transform") import.warnings.push_back("transforms of textures are left out");
    if (name == "KHR_materials_unlit")
      import.warnings.push_back("unlit materials are read as lit ones; their base colour is the reflectance");
  }
}

ImportProblem read(const std::string& bytes, const std::string& folder, const ImportBudget& budget,
                   GltfImport& import) {
  try {
    SceneFolder opened{folder, budget, import.files};
    const tinygltf::Model gltf = parse(bytes, opened);
    checkExtensions(gltf);
    warnOfOmissions(gltf, import);
    import.materials = materialsOf(gltf, readImages(gltf, import), import);
    NodeReader nodes(gltf, import);
    for (const int root : rootsOf(gltf)) nodes.readTree(root);
    nodes.readMeshes(budget);
  } catch (const Fault& fault) {
    return fault;
  } catch (const raster::InputError&) {  // of the budget
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // of tinygltf's JSON parser
    return {"is no valid glTF", exportAgain};
  }
  return {};
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default")))
const hemitex::radiosity::GltfReader hemitexGltfReader = {hemitex::radiosity::read};
