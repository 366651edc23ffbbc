/// A convex polygon clipped by a plane, and the form factor from a point to it in closed form.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace hemitex::radiosity {

/// A polygon of up to seven corners that is clipped by a plane has up to eight.
struct ConvexPart {
  std::array<glm::dvec3, 8> corners;
  std::size_t count = 0;

  std::span<const glm::dvec3> span() const { return {corners.data(), count}; }
};

/// The part of a convex polygon, of up to seven corners, in front of the plane through `point`; nothing if it is no
/// higher than rounding.
ConvexPart inFrontOf(std::span<const glm::dvec3> polygon, const glm::dvec3& point, const glm::dvec3& normal);
ConvexPart inFrontOf(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& point, const glm::dvec3& normal);

/// The form factor from a point with a unit normal to a polygon above its horizon that winds counter-clockwise in
/// front, without blockers: Lambert's formula (Lambert 1760). The relative rounding error is about 1e-16 over the
/// angular size.
double fromPoint(const glm::dvec3& point, const glm::dvec3& normal, const ConvexPart& polygon);

}  // namespace hemitex::radiosity
