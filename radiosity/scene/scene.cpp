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

void measureBounds(Scene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Surface& surface : scene.surfaces) {
    for (const Triangle& triangle : surface.triangles) {
      for (const glm::dvec3& p : triangle.position) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
  }
  scene.origin = 0.5 * (low + high);
  scene.extent = glm::length(high - low);
}

}  // namespace hemitex::radiosity
