#include "radiosity/textures/gltf_scene.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// The position and texture coordinate of a corner.
using Vertex = std::array<float, 5>;

Vertex vertexOf(const Triangle& triangle, std::size_t corner, const glm::dvec3& origin) {
  const glm::vec3 position(triangle.position[corner] - origin);
  const glm::vec2 texcoord(triangle.texcoord[corner].x, 1 - triangle.texcoord[corner].y);
  return {position.x, position.y, position.z, texcoord.x, texcoord.y};
}

/// Vertices in the order of their first corners; equal ones are written once.
GltfPrimitive primitiveOf(const Scene& lit, const LitPart& part) {
  GltfPrimitive primitive{part.material, {}, {}, {}};
  std::map<Vertex, std::uint32_t> numbers;
  for (const std::uint32_t surface : part.surfaces)
    for (const Triangle& triangle : lit.surfaces[surface].triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vertex vertex = vertexOf(triangle, corner, lit.origin);
        const auto [known, isNew] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size()));
        primitive.corners.push_back(known->second);
        if (!isNew) continue;
        primitive.positions.emplace_back(vertex[0], vertex[1], vertex[2]);
        primitive.texcoords.emplace_back(vertex[3], vertex[4]);
      }
  return primitive;
}

/// Nodes of the parts, each with the primitives of an object, then those of the objects above them.
std::vector<GltfObject> nodesOf(const Scene& lit, const std::vector<LitPart>& parts) {
  std::vector<GltfPrimitive> primitives(parts.size());
  raster::parallelFor(parts.size(), [&](std::size_t p) { primitives[p] = primitiveOf(lit, parts[p]); });
  std::vector<GltfObject> nodes;
  std::vector<int> objects;         // in the scene, of each node; -1 for none
  std::map<int, int> nodeOfObject;  // as far as there are
  const auto addNode = [&](const std::string& name, int object) {
    if (object >= 0) nodeOfObject.emplace(object, static_cast<int>(nodes.size()));
    nodes.push_back({name, {}, {}});
    objects.push_back(object);
  };
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::optional<int> object = parts[p].object;
    if (!object)
      addNode(lit.materials[static_cast<std::size_t>(parts[p].material)].name, -1);
    else if (!nodeOfObject.contains(*object))
      addNode(lit.objects[static_cast<std::size_t>(*object)].name, *object);
    nodes.back().primitives.push_back(std::move(primitives[p]));
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (objects[n] < 0) continue;
    const std::optional<int> parent = lit.objects[static_cast<std::size_t>(objects[n])].parent;
    if (!parent) continue;
    if (!nodeOfObject.contains(*parent)) addNode(lit.objects[static_cast<std::size_t>(*parent)].name, *parent);
    nodes[n].parent = nodeOfObject.at(*parent);
  }
  return nodes;
}

/// Planes that enclose the scene and leave a viewer with 24 bits of depth enough of them: a camera at a wall of a room
/// of 5 m sees what is farther than 5 mm.
GltfCamera cameraOf(const Scene& lit, const PictureView& view) {
  const CameraAxes axes = axesOf(view.camera);
  GltfCamera camera;
  camera.toWorld = {glm::dvec4(axes.right, 0), glm::dvec4(axes.up, 0), glm::dvec4(-axes.forward, 0),
                    glm::dvec4(view.camera.eye, 1)};
  camera.fov = view.camera.fov * std::numbers::pi / 180;
  camera.aspect = view.aspect;
  camera.near = view.metresPerUnit * lit.extent / 1000;
  camera.far = view.metresPerUnit * (glm::distance(view.camera.eye, lit.origin) + lit.extent);
  return camera;
}

/// The columns are where the axes of the scene are in glTF. If z points up, y points to the back.
glm::dmat4 toGltf(const PictureView& view) {
  const double s = view.metresPerUnit;
  if (view.up == 2) return {{s, 0, 0, 0}, {0, 0, -s, 0}, {0, s, 0, 0}, {0, 0, 0, 1}};
  return {{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, s, 0}, {0, 0, 0, 1}};
}

}  // namespace

std::vector<LitPart> litParts(const Scene& lit, std::size_t maxObjects) {
  const auto partsOf = [&](bool byObject) {
    std::map<std::optional<int>, std::uint32_t> firstOfObject;
    std::map<std::pair<std::uint32_t, int>, std::size_t> numbers;
    std::vector<LitPart> parts;
    for (std::uint32_t s = 0; s < lit.surfaces.size(); ++s) {
      const std::optional<int> object = byObject ? lit.surfaces[s].object : std::nullopt;
      const std::uint32_t first = firstOfObject.try_emplace(object, s).first->second;
      const int material = lit.surfaces[s].material;
      const auto [known, isNew] = numbers.try_emplace({first, material}, parts.size());
      if (isNew) parts.push_back({object, material, {}});
      parts[known->second].surfaces.push_back(s);
    }
    std::stable_sort(parts.begin(), parts.end(), [&](const LitPart& a, const LitPart& b) {
      return firstOfObject.at(a.object) < firstOfObject.at(b.object);
    });
    return parts;
  };
  std::vector<LitPart> parts = partsOf(true);
  return parts.size() <= maxObjects ? parts : partsOf(false);
}

GltfModel makeGltfModel(const Scene& lit, const PictureView& view, std::vector<GltfTexture> textures,
                        std::size_t maxObjects) {
  GltfModel model;
  model.toGltf = toGltf(view);
  model.origin = lit.origin;
  model.textures = std::move(textures);
  for (const Material& material : lit.materials) model.materials.push_back({material.name, *material.reflectanceMap});
  model.objects = nodesOf(lit, litParts(lit, maxObjects));
  model.camera = cameraOf(lit, view);
  return model;
}

}  // namespace hemitex::radiosity
