/// Boxes around runs of triangles, which speed up the search for the nearest triangle of a scene.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Consecutive triangles of one surface, and the box around them.
struct TriangleBox {
  glm::dvec3 low, high;
  std::uint32_t surface = 0;
  std::uint32_t first = 0, end = 0;  ///< in the surface
  std::uint32_t number = 0;          ///< of the first triangle, in the scene
};

/// All triangles of a scene, in their order.
std::vector<TriangleBox> triangleBoxes(const Scene& scene);

/// The squared distance from a point to a box; 0 inside.
double squaredDistance(const glm::dvec3& point, const TriangleBox& box);

}  // namespace hemitex::radiosity
