/// Directions into a polygon as seen from a point, uniform in solid angle. So the weight of a direction is bounded by
/// the solid angle of a hemisphere, however near the polygon is. Points uniform in area would have unbounded weights.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace hemitex::reference {

/// Unit vectors to the corners of a spherical triangle, of either winding.
using SphericalTriangle = std::array<glm::dvec3, 3>;

/// In steradians, 0 to 2 pi (van Oosterom and Strackee, The solid angle of a plane triangle, 1983).
double solidAngle(const SphericalTriangle& triangle);

/// Maps a point (x, y) of the unit square to a direction in a spherical triangle; equal areas map to equal solid angles
/// (Arvo, Stratified sampling of spherical triangles, 1995). The solid angle must be above 1e-7; smaller ones have too
/// few digits.
glm::dvec3 directionIn(const SphericalTriangle& triangle, double x, double y);

/// A direction from a point into a polygon, and the solid angle that it represents.
struct Aim {
  glm::dvec3 direction;   ///< unit
  double solidAngle = 0;  ///< the mean of f(direction) * solidAngle is the integral of f over the polygon's directions
};

/// Into a convex polygon from a point outside its plane, by a point (x, y) of the unit square. Polygons below 1e-6
/// steradians are sampled by area.
Aim aimInto(std::span<const glm::dvec3> polygon, const glm::dvec3& point, double x, double y);

}  // namespace hemitex::reference
