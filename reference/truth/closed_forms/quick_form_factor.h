/// The form factor between two facets without blockers, as polygon_to_polygon.h, but in a few microseconds: with double
/// precision, few points, and errors that are small enough for visible parts that are measured.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "reference/truth/closed_forms/merged_pieces.h"

namespace hemitex::reference {

/// The share of the flux leaving `from` that reaches `to`, without blockers. Both are planar and convex, have up to
/// seven corners, and wind counter-clockwise in front. Each is clipped to the part in front of the other's plane. If
/// the smaller one is at a distance, Gauss' rules average Lambert's formula over it (Dunavant, High degree efficient
/// symmetrical Gaussian quadrature rules for the triangle, 1985); otherwise the result is that of polygonToPolygon,
/// with an error of 1e-6, or absolutely 1e-10. The relative error is below 1e-3, and mostly below 1e-4.
double quickFormFactor(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);
/// The same between two planar surfaces: the mean over the polygons of `from`, by area.
double quickFormFactor(const ConvexPolygons& from, const ConvexPolygons& to);

}  // namespace hemitex::reference
