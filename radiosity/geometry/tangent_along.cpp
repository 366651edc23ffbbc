#include "radiosity/geometry/tangent_along.h"

namespace hemitex::radiosity {

glm::dvec3 tangentAlong(const glm::dvec3& normal, const glm::dvec3& up) {
  const glm::dvec3 tangent = up - glm::dot(up, normal) * normal;
  const double length = glm::length(tangent);
  if (length > 1e-6 * glm::length(up)) return tangent / length;
  const glm::dvec3 a = glm::abs(normal);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                   : glm::dvec3(0, 0, 1);
  return tangentAlong(normal, axis);
}

}  // namespace hemitex::radiosity
