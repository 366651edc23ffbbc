#include "radiosity/textures/gltf_scene.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "radiosity/images/image.h"
#include "radiosity/textures/file_names.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// An object of the file and its surfaces.
struct Part {
  std::string name;
  int material = 0;
  std::vector<std::size_t> surfaces;
};

std::vector<Part> partsBySurface(const Scene& lit) {
  const std::vector<std::string> names = objectNames(lit);
  std::vector<Part> parts;
  for (std::size_t s = 0; s < lit.surfaces.size(); ++s) parts.push_back({names[s], lit.surfaces[s].material, {s}});
  return parts;
}

std::vector<Part> partsByMaterial(const Scene& lit) {
  std::vector<Part> parts;
  for (const Material& material : lit.materials) parts.push_back({material.name, static_cast<int>(parts.size()), {}});
  for (std::size_t s = 0; s < lit.surfaces.size(); ++s)
    parts[static_cast<std::size_t>(lit.surfaces[s].material)].surfaces.push_back(s);
  std::erase_if(parts, [](const Part& part) { return part.surfaces.empty(); });
  return parts;
}

/// The position, texture coordinate and colour of a corner.
using Vertex = std::array<float, 8>;

Vertex vertexOf(const Triangle& triangle, std::size_t corner, const glm::dvec3& origin) {
  const glm::vec3 position(triangle.position[corner] - origin);
  const glm::vec2 texcoord(triangle.texcoord[corner].x, 1 - triangle.texcoord[corner].y);
  const glm::vec3 colour = triangle.cornerColor ? decodeSrgb((*triangle.cornerColor)[corner]) : glm::dvec3(1);
  return {position.x, position.y, position.z, texcoord.x, texcoord.y, colour.x, colour.y, colour.z};
}

/// Vertices in the order of their first corners; equal ones are written once.
GltfObject objectOf(const Scene& lit, const Part& part) {
  GltfObject object{part.name, part.material, {}, {}, {}, {}};
  const bool isColoured = lit.surfaces[part.surfaces.front()].triangles.front().cornerColor.has_value();
  std::map<Vertex, std::uint32_t> numbers;
  for (const std::size_t surface : part.surfaces)
    for (const Triangle& triangle : lit.surfaces[surface].triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vertex vertex = vertexOf(triangle, corner, lit.origin);
        const auto [known, isNew] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size()));
        object.corners.push_back(known->second);
        if (!isNew) continue;
        object.positions.emplace_back(vertex[0], vertex[1], vertex[2]);
        object.texcoords.emplace_back(vertex[3], vertex[4]);
        if (isColoured) object.colours.emplace_back(vertex[5], vertex[6], vertex[7]);
      }
  return object;
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
  camera.near = lit.extent / 1000;
  camera.far = glm::distance(view.camera.eye, lit.origin) + lit.extent;
  return camera;
}

}  // namespace

GltfModel makeGltfModel(const Scene& lit, const PictureView& view, std::vector<std::vector<unsigned char>> pngs,
                        std::size_t maxObjects) {
  GltfModel model;
  model.origin = lit.origin;
  for (std::size_t t = 0; t < pngs.size(); ++t) model.textures.push_back({lit.materials[t].name, std::move(pngs[t])});
  for (const Material& material : lit.materials) model.materials.push_back({material.name, material.reflectanceMap});
  const std::vector<Part> parts = lit.surfaces.size() <= maxObjects ? partsBySurface(lit) : partsByMaterial(lit);
  const auto isUsed = [&](int material) {
    return std::any_of(parts.begin(), parts.end(), [&](const Part& part) { return part.material == material; });
  };
  if (!isUsed(static_cast<int>(model.materials.size()) - 1)) model.materials.pop_back();  // the one without a map
  model.objects.resize(parts.size());
  raster::parallelFor(parts.size(), [&](std::size_t p) { model.objects[p] = objectOf(lit, parts[p]); });
  model.camera = cameraOf(lit, view);
  return model;
}

}  // namespace hemitex::radiosity
