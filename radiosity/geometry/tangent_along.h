/// Directions in the plane of a surface.
#pragma once

#include <glm/glm.hpp>

namespace hemitex::radiosity {

/// A unit vector at right angles to the unit vector `normal`, as near to `up` as possible. If `up` is zero or parallel
/// to the normal, as near as possible to the axis that lies best in the plane.
glm::dvec3 tangentAlong(const glm::dvec3& normal, const glm::dvec3& up);

}  // namespace hemitex::radiosity
