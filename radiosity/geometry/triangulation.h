/// Triangulates polygons: a fan from the first corner if the polygon is convex, else ear clipping.
///
/// A polygon is projected along its Newell normal, the sum of the cross products of its edges. This normal also exists
/// for polygons that are not quite planar. An *ear* is a convex corner whose triangle with the corners before and
/// behind it contains no other corner. Each simple polygon has two ears (Meisters 1975), so that they can be cut off
/// one by one. The next ear is the first one after the last, which makes the result unique. A hole may be connected to
/// the outline by a double edge: corners at the same place do not prevent an ear.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// Whether a triangle has area: its height over the longest edge is above the rounding noise of its coordinates. The
/// noise is four epsilons (2^-50 in total) of the largest absolute coordinate.
bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// A normal of a polygon by Newell's method, whose length is twice its area.
glm::dvec3 newellNormal(std::span<const glm::dvec3> polygon);

struct Triangulation {
  /// Corners of the polygon, counted from 0; two triangles less than corners. Some triangles may have no area.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool crossing = false;  ///< the polygon crosses itself, so that the triangles are a guess
};

/// Triangulates `polygon`, which has at least 3 corners. A k-d tree finds corners in the triangles of others, so that
/// 100,000 corners take seconds.
Triangulation triangulate(std::span<const glm::dvec3> polygon);

}  // namespace hemitex::radiosity
