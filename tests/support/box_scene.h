/// Scenes made of quads, for tests without files.
#pragma once

#include <string>

#include "radiosity/scene/scene.h"

namespace hemitex::tests {

/// A surface of two triangles: corners counter-clockwise in front; the chart follows its corners.
inline radiosity::Surface quad(const std::string& name, const std::array<glm::dvec3, 4>& corner, int material = 0) {
  const std::array<glm::dvec2, 4> chart{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  radiosity::Surface surface;
  surface.name = surface.family = name;
  surface.material = material;
  for (const std::array<std::size_t, 3>& k : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
    radiosity::Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      triangle.position[c] = corner[k[c]];
      triangle.chart[c] = triangle.texcoord[c] = chart[k[c]];
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

/// Sets origin and extent from the surfaces, as loadScene does.
inline radiosity::Scene finish(radiosity::Scene scene) {
  glm::dvec3 low(scene.surfaces.front().triangles.front().position[0]), high(low);
  for (const radiosity::Surface& surface : scene.surfaces)
    for (const radiosity::Triangle& triangle : surface.triangles)
      for (const glm::dvec3& corner : triangle.position) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
  scene.origin = 0.5 * (low + high);
  scene.extent = glm::length(high - low);
  return scene;
}

inline radiosity::Material material(const std::string& name, const glm::dvec3& reflectance,
                                    const glm::dvec3& emission) {
  radiosity::Material result;
  result.name = name;
  result.reflectance = reflectance;
  result.emission = emission;
  return result;
}

/// The six faces of the cube [0, 1]^3, seen from inside, of one material.
inline radiosity::Scene closedCube(const glm::dvec3& reflectance, const glm::dvec3& emission) {
  radiosity::Scene scene;
  scene.materials.push_back(material("grey", reflectance, emission));
  scene.surfaces = {quad("left", {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}}),
                    quad("right", {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}}),
                    quad("floor", {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}),
                    quad("ceiling", {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}}),
                    quad("front", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}),
                    quad("back", {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}})};
  return finish(std::move(scene));
}

}  // namespace hemitex::tests
