#include "radiosity/projection/triangle_boxes.h"

#include <algorithm>
#include <limits>

namespace hemitex::radiosity {
namespace {

/// Maximum number of triangles per box. Larger runs have large boxes; smaller runs are too many.
constexpr std::uint32_t maxTriangles = 32;

TriangleBox boxAround(const std::vector<Triangle>& triangles, std::uint32_t first, std::uint32_t end) {
  const double infinity = std::numeric_limits<double>::infinity();
  TriangleBox box{glm::dvec3(infinity), glm::dvec3(-infinity), 0, first, end, 0};
  for (std::uint32_t t = first; t < end; ++t)
    for (const glm::dvec3& corner : triangles[t].position) {
      box.low = glm::min(box.low, corner);
      box.high = glm::max(box.high, corner);
    }
  return box;
}

}  // namespace

std::vector<TriangleBox> triangleBoxes(const Scene& scene) {
  std::vector<TriangleBox> boxes;
  std::uint32_t number = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const auto count = static_cast<std::uint32_t>(scene.surfaces[s].triangles.size());
    for (std::uint32_t first = 0; first < count; first += maxTriangles) {
      boxes.push_back(boxAround(scene.surfaces[s].triangles, first, std::min(first + maxTriangles, count)));
      boxes.back().surface = s;
      boxes.back().number = number + first;
    }
    number += count;
  }
  return boxes;
}

double squaredDistance(const glm::dvec3& point, const TriangleBox& box) {
  const glm::dvec3 offset = point - glm::clamp(point, box.low, box.high);
  return glm::dot(offset, offset);
}

}  // namespace hemitex::radiosity
