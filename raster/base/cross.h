/// The cross product of vectors in a plane.
#pragma once

#include <glm/glm.hpp>

namespace hemitex::raster {

/// Twice the signed area of the triangle that two vectors span.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace hemitex::raster
