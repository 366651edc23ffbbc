/// The nodes of a glTF file with their meshes and cameras.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/unique_names.h"
#include "radiosity/gltf/tinygltf/accessors.h"
#include "radiosity/gltf/tinygltf/model_parts.h"

namespace hemitex::radiosity {
namespace {

// ---- Meshes --------------------------------------------------------------------------------------------------------

/// The accessor of an attribute; nothing if there is none.
std::optional<int> attributeOf(const std::map<std::string, int>& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

/// Positions with the targets of morphs, each times its weight.
std::vector<glm::dvec3> positionsOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                    const std::vector<double>& weights, const glm::dmat4& toWorld) {
  const std::optional<int> accessor = attributeOf(primitive.attributes, "POSITION");
  if (!accessor) return {};
  std::vector<double> values = valuesOf(gltf, *accessor, TINYGLTF_TYPE_VEC3, 3);
  for (std::size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
    const std::optional<int> target = attributeOf(primitive.targets[t], "POSITION");
    if (!target || weights[t] == 0) continue;
    const std::vector<double> moved = valuesOf(gltf, *target, TINYGLTF_TYPE_VEC3, 3, values.size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += weights[t] * moved[i];
  }
  std::vector<glm::dvec3> positions;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    positions.emplace_back(toWorld * glm::dvec4(values[i], values[i + 1], values[i + 2], 1));
    if (!isFinite(positions.back()))
      throw Fault{numbered("vertex", i / 3) + " has a coordinate that is not finite", exportAgain};
  }
  return positions;
}

/// Of the set with a number.
std::vector<glm::dvec2> texcoordsOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive, int set,
                                    std::size_t vertices) {
  const std::optional<int> accessor = attributeOf(primitive.attributes, "TEXCOORD_" + std::to_string(set));
  if (!accessor) return {};
  const std::vector<double> values = valuesOf(gltf, *accessor, TINYGLTF_TYPE_VEC2, 2, vertices);
  std::vector<glm::dvec2> texcoords;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    if (!std::isfinite(values[i]) || !std::isfinite(values[i + 1]))
      throw Fault{numbered("vertex", i / 2) + " has a texture coordinate that is not finite", exportAgain};
    texcoords.emplace_back(values[i], values[i + 1]);
  }
  return texcoords;
}

/// Empty if the second coordinates are missing, or faulty, with a warning: a scene is complete without them.
std::vector<glm::dvec2> secondCoordsOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                       std::size_t vertices, std::vector<std::string>& warnings) {
  try {
    return texcoordsOf(gltf, primitive, 1, vertices);
  } catch (const Fault& fault) {
    warnings.push_back("TEXCOORD_1 of a mesh is left out: " + fault.problem);
    return {};
  }
}

/// Linear colours of three or four components, without alpha.
std::vector<glm::dvec3> coloursOf(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                                  std::size_t vertices) {
  const std::optional<int> accessor = attributeOf(primitive.attributes, "COLOR_0");
  if (!accessor) return {};
  const int type = itemAt(gltf.accessors, *accessor, "accessor").type;
  const std::size_t width = type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
  const std::vector<double> values =
      valuesOf(gltf, *accessor, width == 4 ? type : TINYGLTF_TYPE_VEC3, static_cast<int>(width), vertices);
  std::vector<glm::dvec3> colours;
  for (std::size_t i = 0; i < values.size(); i += width) {
    colours.emplace_back(values[i], values[i + 1], values[i + 2]);
    if (!isFinite(colours.back()))
      throw Fault{numbered("vertex", i / width) + " has a colour that is not finite", exportAgain};
    colours.back() = glm::clamp(colours.back(), 0.0, 1.0);
  }
  return colours;
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
  if (accessor.bufferView < 0 && accessor.sparse.isSparse) return accessor.count;
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

/// Collects the meshes, the camera and the lights of the nodes of a scene.
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
      if (node.mesh >= 0) addInstances(node, {index, number, toWorld});
      if (node.camera >= 0) readCamera(node, toWorld);
      if (const auto* const light = extensionOf(node.extensions, "KHR_lights_punctual"))
        readLight(numbersIn(*light, "light"), node.name, toWorld);
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

  std::vector<PartPlace> places;  ///< of the parts

 private:
  /// A node with a mesh.
  struct Instance {
    int node = 0;      // of the file
    int imported = 0;  // in the import
    glm::dmat4 toWorld{1.0};
  };

  /// A node with a mesh is there once, or at the places of EXT_mesh_gpu_instancing, each a node below it.
  void addInstances(const tinygltf::Node& node, const Instance& first) {
    const tinygltf::Value* const extension = extensionOf(node.extensions, "EXT_mesh_gpu_instancing");
    if (extension == nullptr || !extension->IsObject() || !extension->Has("attributes")) {
      instances_.push_back(first);
      return;
    }
    const auto valuesNamed = [&](const char* name, int type, int components) {
      const tinygltf::Value& attributes = extension->Get("attributes");
      return attributes.IsObject() && attributes.Has(name)
                 ? valuesOf(gltf_, integerIn(attributes, name, -1), type, components)
                 : std::vector<double>();
    };
    const std::vector<double> translations = valuesNamed("TRANSLATION", TINYGLTF_TYPE_VEC3, 3),
                              rotations = valuesNamed("ROTATION", TINYGLTF_TYPE_VEC4, 4),
                              scales = valuesNamed("SCALE", TINYGLTF_TYPE_VEC3, 3);
    const auto part = [](const std::vector<double>& values, std::size_t i, std::size_t width) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i * width);
      return values.size() < (i + 1) * width ? std::vector<double>()
                                             : std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(width));
    };
    const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    for (std::size_t i = 0; i < count; ++i) {
      tinygltf::Node place;
      place.name = node.name;
      place.translation = part(translations, i, 3);
      place.rotation = part(rotations, i, 4);
      place.scale = part(scales, i, 3);
      instances_.push_back({first.node, static_cast<int>(import_.nodes.size()), first.toWorld * localMatrix(place)});
      import_.nodes.push_back({node.name.empty() ? "node-" + std::to_string(first.node) : node.name, first.imported});
    }
  }

  void readMesh(const Instance& instance) {
    const tinygltf::Node& node = gltf_.nodes[static_cast<std::size_t>(instance.node)];
    const tinygltf::Mesh& mesh = gltf_.meshes[static_cast<std::size_t>(node.mesh)];
    std::string name = node.name.empty() ? mesh.name : node.name;
    if (name.empty()) name = "node-" + std::to_string(instance.node);
    name = names_.add(name);
    import_.nodes[static_cast<std::size_t>(instance.imported)].name = name;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      try {
        readPrimitive(mesh.primitives[p], node.weights.empty() ? mesh.weights : node.weights, instance);
      } catch (const Fault& fault) {
        throw Fault{"the mesh of node `" + name + "`: " + fault.problem, fault.advice};
      }
      if (places.size() < import_.parts.size())
        places.push_back({instance.node, static_cast<int>(p), glm::determinant(glm::dmat3(instance.toWorld)) < 0});
    }
  }

  void readPrimitive(const tinygltf::Primitive& primitive, const std::vector<double>& weights,
                     const Instance& instance) {
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
    part.positions = positionsOf(gltf_, primitive, weights, toWorld);
    const int set = part.material ? import_.materials[static_cast<std::size_t>(*part.material)].texcoords : 0;
    part.texcoords = texcoordsOf(gltf_, primitive, set, part.positions.size());
    part.secondCoords = secondCoordsOf(gltf_, primitive, part.positions.size(), import_.warnings);
    part.colours = coloursOf(gltf_, primitive, part.positions.size());
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

  /// `number`: of the light, in a list.
  void readLight(const std::vector<double>& number, const std::string& node, const glm::dmat4& toWorld) {
    const tinygltf::Light& light = itemAt(gltf_.lights, number.empty() ? -1 : static_cast<int>(number[0]), "light");
    const std::vector<double> colour = light.color.size() == 3 ? light.color : std::vector<double>(3, 1);
    ImportedLight read{.kind = ImportedLight::Kind::Point,
                       .name = !node.empty()         ? node
                               : !light.name.empty() ? light.name
                                                     : "lamp",
                       .position = toWorld[3],
                       .direction = -glm::dvec3(toWorld[2]),
                       .intensity = light.intensity * glm::dvec3(colour[0], colour[1], colour[2]),
                       .innerAngle = light.spot.innerConeAngle,
                       .outerAngle = light.spot.outerConeAngle};
    const std::string which = "the light `" + read.name + "`";
    if (light.type == "spot")
      read.kind = ImportedLight::Kind::Spot;
    else if (light.type == "directional")
      read.kind = ImportedLight::Kind::Directional;
    else if (light.type != "point")
      throw Fault{which + " has the unknown type `" + light.type + "`", exportAgain};
    if (read.kind != ImportedLight::Kind::Point) read.direction /= glm::length(read.direction);
    if (!isFinite(read.intensity) || glm::any(glm::lessThan(read.intensity, glm::dvec3(0))))
      throw Fault{which + " has a colour or intensity that is no number of at least 0", exportAgain};
    if (!isFinite(read.position) || !isFinite(read.direction))
      throw Fault{which + " has no finite position and direction", exportAgain};
    if (read.kind == ImportedLight::Kind::Spot &&
        !(read.innerAngle >= 0 && read.innerAngle <= read.outerAngle && read.outerAngle > 0 &&
          read.outerAngle <= std::numbers::pi / 2 + 1e-6))
      throw Fault{which + " has cone angles out of range",
                  "use 0 <= inner <= outer <= pi/2, and an outer angle above 0"};
    if (light.range > 0)
      import_.warnings.push_back(which +
                                 " has a range, which is left out: light falls with the squared distance alone");
    import_.lights.push_back(std::move(read));
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

}  // namespace

std::vector<PartPlace> readNodes(const tinygltf::Model& gltf, const ImportBudget& budget, GltfImport& import) {
  NodeReader nodes(gltf, import);
  for (const int root : rootsOf(gltf)) nodes.readTree(root);
  nodes.readMeshes(budget);
  return std::move(nodes.places);
}

}  // namespace hemitex::radiosity
