/// The form factor from a point to a polygon: Lambert's contour integral.
///
/// Let n be the normal at the point, and r_i the vectors from the point to the corners of the part above the horizon.
/// Then
///
///   F = 1/(2 pi) |sum_i theta_i n . (r_i x r_i+1) / |r_i x r_i+1||,
///
/// where theta_i is the angle between r_i and r_i+1. The angle is computed with square roots and a polynomial, so that
/// all machines give the same bits.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace hemitex::radiosity {

/// From an element of area at `point`, facing along the unit vector `normal`, to a convex planar polygon, whose front
/// the point sees. Blockers are ignored. The error is below 1e-14 of 1, the form factor to all that is in front. 0 if
/// the polygon is below the horizon.
///
/// Source: Lambert, Photometria (1760); Baum, Rushmeier and Winget, Improving radiosity solutions through the use of
/// analytically determined form-factors (1989).
double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal, std::span<const glm::dvec3> polygon);

}  // namespace hemitex::radiosity
