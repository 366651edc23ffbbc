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

/// The position, texture coordinate, second texture coordinate and colour of a corner.
using Vertex = std::array<float, 10>;

/// glTF measures v from the top.
glm::vec2 fromTop(const glm::dvec2& texcoord) { return {texcoord.x, 1 - texcoord.y}; }

/// Vertices in the order of their first corners; equal ones are written once.
GltfPrimitive primitiveOf(const Scene& scene, const LitPart& part, const CoordinateOf& second) {
  GltfPrimitive primitive{part.material, {}, {}, {}};
  const bool isColoured = std::any_of(part.surfaces.begin(), part.surfaces.end(),
                                      [&](std::uint32_t surface) { return scene.surfaces[surface].hasColours; });
  std::map<Vertex, std::uint32_t> numbers;
  for (const std::uint32_t surface : part.surfaces)
    for (const Triangle& triangle : scene.surfaces[surface].triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const glm::vec3 position(triangle.position[corner] - scene.origin);
        const glm::vec2 first = fromTop(triangle.texcoord[corner]);
        const glm::vec2 other = second ? fromTop(second(surface, triangle.chart[corner])) : glm::vec2(0);
        const glm::vec3& colour = triangle.colour[corner];
        const Vertex vertex{position.x, position.y, position.z, first.x,  first.y,
                            other.x,    other.y,    colour.x,   colour.y, colour.z};
        const auto [known, isNew] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size()));
        primitive.corners.push_back(known->second);
        if (!isNew) continue;
        primitive.positions.push_back(position);
        primitive.texcoords.push_back(first);
        if (second) primitive.lightMapCoords.push_back(other);
        if (isColoured) primitive.colours.push_back(colour);
      }
  return primitive;
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

std::vector<GltfObject> gltfObjects(const Scene& lit, const CoordinateOf& second, std::size_t maxObjects) {
  const std::vector<LitPart> parts = litParts(lit, maxObjects);
  std::vector<GltfPrimitive> primitives(parts.size());
  raster::parallelFor(parts.size(), [&](std::size_t p) { primitives[p] = primitiveOf(lit, parts[p], second); });
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

GltfCamera gltfCamera(const Scene& scene, const PictureView& view) {
  const CameraAxes axes = axesOf(view.camera);
  GltfCamera camera;
  camera.toWorld = {glm::dvec4(axes.right, 0), glm::dvec4(axes.up, 0), glm::dvec4(-axes.forward, 0),
                    glm::dvec4(view.camera.eye, 1)};
  camera.fov = view.camera.fov * std::numbers::pi / 180;
  camera.aspect = view.aspect;
  camera.near = view.metresPerUnit * scene.extent / 1000;
  camera.far = view.metresPerUnit * (glm::distance(view.camera.eye, scene.origin) + scene.extent);
  return camera;
}

/// The columns are where the axes of the scene are in glTF. If z points up, y points to the back.
glm::dmat4 toGltf(const PictureView& view) {
  const double s = view.metresPerUnit;
  if (view.up == 2) return {{s, 0, 0, 0}, {0, 0, -s, 0}, {0, s, 0, 0}, {0, 0, 0, 1}};
  return {{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, s, 0}, {0, 0, 0, 1}};
}

GltfModel makeGltfModel(const Scene& lit, const PictureView& view, std::vector<GltfTexture> textures,
                        std::size_t maxObjects) {
  GltfModel model;
  model.toGltf = toGltf(view);
  model.origin = lit.origin;
  model.textures = std::move(textures);
  for (const Material& material : lit.materials) {
    model.materials.push_back({material.name, material.reflectanceMap});
    model.materials.back().isCutOut = material.cutOut != nullptr;
  }
  model.objects = gltfObjects(lit, {}, maxObjects);
  model.camera = gltfCamera(lit, view);
  return model;
}

}  // namespace hemitex::radiosity
