/// Polygons become triangles: a fan from the first corner where the polygon is convex, ear clipping otherwise.
///
/// A polygon is looked at along its Newell normal, the sum of the cross products of its edges, which a polygon that is
/// not quite planar has too. An *ear* is a corner where the polygon turns left and whose triangle, with the corners
/// before and behind it, holds no other corner; every simple polygon has two (Meisters 1975), so they can be cut off
/// one by one. The next ear is the first one found going round from the last one, which makes the result unique.
/// A hole that is tied to the outline by an edge there and back is fine: corners at the same place do not stop an ear.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// Whether a triangle has area: its height over the longest edge is above the rounding noise of its coordinates, four
/// epsilons (2^-50 in all) of the largest one in size.
bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

struct Triangulation {
  /// Corners of the polygon, counted from 0; two triangles less than corners. Some may have no area.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool crossing = false;  ///< the polygon crosses itself, and the triangles are a guess
};

/// `polygon` has at least 3 corners. Ear clipping takes time quadratic in them.
Triangulation triangulate(std::span<const glm::dvec3> polygon);

}  // namespace hemitex::radiosity
