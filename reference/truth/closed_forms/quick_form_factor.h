/// The form factor between two triangles without blockers, as polygon_to_polygon.h, but in a few microseconds for
/// triangles that are apart: with double precision and few points.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

using TriangleCorners = std::array<glm::dvec3, 3>;

/// The share of the flux leaving `from` that reaches `to`, without blockers. Both wind counter-clockwise in front. Each
/// is clipped to the part in front of the other's plane. If the smaller one is at a distance, Gauss' rules average
/// Lambert's formula over it (Dunavant, High degree efficient symmetrical Gaussian quadrature rules for the triangle,
/// 1985); otherwise the result is that of polygonToPolygon. The relative error is below 1e-3, and mostly below 1e-4.
double quickFormFactor(const TriangleCorners& from, const TriangleCorners& to);
/// The same between two planar surfaces: the mean over the triangles of `from`, by area.
double quickFormFactor(const radiosity::Surface& from, const radiosity::Surface& to);

}  // namespace hemitex::reference
