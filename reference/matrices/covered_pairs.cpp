#include "reference/matrices/covered_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemitex::reference {
namespace {

/// Whether the line through a point along the normal of a surface meets it.
bool isOver(const radiosity::Surface& surface, const glm::dvec3& normal, const glm::dvec3& point) {
  return std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const radiosity::Triangle& triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 &a = triangle.position[k], &b = triangle.position[(k + 1) % 3];
      if (glm::dot(glm::cross(b - a, point - a), normal) < 0) return false;
    }
    return true;
  });
}

/// Whether a surface covers the middle of a parallel one, or a point near one of its corners.
bool covers(const radiosity::Surface& surface, const radiosity::Surface& other) {
  const glm::dvec3 normal = radiosity::normal(surface.triangles.front()), middle = middleOf(other);
  if (isOver(surface, normal, middle)) return true;
  for (const radiosity::Triangle& triangle : other.triangles)
    for (const glm::dvec3& corner : triangle.position)
      if (isOver(surface, normal, corner + 0.01 * (middle - corner))) return true;
  return false;
}

}  // namespace

glm::dvec3 middleOf(const radiosity::Surface& surface) {
  glm::dvec3 sum(0);
  for (const radiosity::Triangle& triangle : surface.triangles)
    sum += radiosity::area(triangle) * (triangle.position[0] + triangle.position[1] + triangle.position[2]) / 3.0;
  return sum / radiosity::area(surface);
}

std::vector<CoveredPair> coveredPairs(const radiosity::Scene& scene) {
  std::vector<glm::dvec3> normal, middle;
  std::vector<double> size;
  for (const radiosity::Surface& surface : scene.surfaces) {
    normal.push_back(radiosity::normal(surface.triangles.front()));
    middle.push_back(middleOf(surface));
    size.push_back(std::sqrt(radiosity::area(surface)));
  }
  const double contact = radiosity::contactTolerance(scene);
  std::vector<CoveredPair> pairs;
  for (std::uint32_t a = 0; a < size.size(); ++a)
    for (std::uint32_t b = a + 1; b < size.size(); ++b) {
      const double cosine = glm::dot(normal[a], normal[b]);
      const double height = glm::dot(normal[a], middle[b] - middle[a]);
      if (std::abs(cosine) < 1 - 1e-6 || std::abs(height) > 0.01 * std::min(size[a], size[b])) continue;
      const radiosity::Surface &one = scene.surfaces[a], &other = scene.surfaces[b];
      if (!covers(one, other) && !covers(other, one)) continue;
      const bool isInFront = height > 0;  // b before a
      if (cosine > 0 && std::abs(height) <= contact)
        pairs.push_back({.front = a, .behind = b, .isOnePlace = true});
      else if (cosine > 0)
        pairs.push_back({.front = isInFront ? b : a, .behind = isInFront ? a : b});
      else if (height <= contact)  // back to back: each hides the other
        for (const auto& [front, behind] : {std::pair(a, b), {b, a}})
          pairs.push_back({.front = front, .behind = behind, .isBackToBack = height >= -contact});
    }
  return pairs;
}

}  // namespace hemitex::reference
