#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {
namespace {

glm::dvec3 doubledArea(const Triangle& t) {
  return glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]);
}

}  // namespace

double area(const Triangle& triangle) { return 0.5 * glm::length(doubledArea(triangle)); }

glm::dvec3 normal(const Triangle& triangle) {
  const glm::dvec3 direction = doubledArea(triangle);
  return direction / glm::length(direction);
}

std::size_t triangleCount(const Scene& scene) {
  std::size_t count = 0;
  for (const Surface& surface : scene.surfaces) count += surface.triangles.size();
  return count;
}

}  // namespace hemitex::radiosity
