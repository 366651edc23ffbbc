/// Directions into a polygon as seen from a point, spread evenly over its solid angle. However near the polygon, none
/// counts for more than the solid angle of a hemisphere; points spread evenly over its area would count without bound.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace hemitex::reference {

/// Unit vectors to the corners of a spherical triangle, of either winding.
using SphericalTriangle = std::array<glm::dvec3, 3>;

/// In steradians, 0 to 2 pi (van Oosterom and Strackee, The solid angle of a plane triangle, 1983).
double solidAngle(const SphericalTriangle& triangle);

/// The direction in a spherical triangle that a point (x, y) of the unit square stands for: equal solid angles for
/// equal areas (Arvo, Stratified sampling of spherical triangles, 1995). The solid angle is above 1e-7: of smaller ones
/// too few digits remain.
glm::dvec3 directionIn(const SphericalTriangle& triangle, double x, double y);

/// A direction from a point into a polygon, and the solid angle that it stands for.
struct Aim {
  glm::dvec3 direction;   ///< unit
  double solidAngle = 0;  ///< the mean of f(direction) * solidAngle is the integral of f over the polygon's directions
};

/// Into a convex polygon, from a point outside its plane, by a point (x, y) of the unit square. A polygon of less than
/// 1e-6 steradians is sampled by area.
Aim aimInto(std::span<const glm::dvec3> polygon, const glm::dvec3& point, double x, double y);

}  // namespace hemitex::reference
