/// The form factor from a point to a polygon: Lambert's contour integral.
///
/// Let n be the normal at the point. Let r_i be the vectors from the point to the corners, counter-clockwise as seen
/// from the point, which the polygon faces. Then
///
///   F = 1/(2 pi) sum_i theta_i n . (r_i+1 x r_i) / |r_i+1 x r_i|,
///
/// where theta_i is the angle between the two vectors, by atan2(|r_i+1 x r_i|, r_i . r_i+1). The part of the polygon
/// below the horizon is clipped; for a piece of the contour along the horizon, the term is the angle itself.
///
/// The terms are as large as the polygon's angular size, but their sum may be as small as its projected solid angle. So
/// a bound of the rounding error is summed too. If it is above 1e-10 of the sum, the sum is computed again in 50
/// digits, which takes a thousand times as long. That happens for polygons that appear narrower than about 2e-5 of
/// their distance, or that are as little above the horizon.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace hemitex::reference {

/// From an element of area at `point`, facing along the unit vector `normal`, to a convex planar polygon that winds
/// counter-clockwise in front. Blockers are ignored. The relative error is below 1e-9 for the given numbers. If
/// `absoluteError` is above 0, an error below it is accepted too, so that 50 digits are seldom needed.
///
/// Returns 0 in three cases: the polygon shows its back, the point lies in its plane (even if it touches the polygon),
/// or the polygon is too low. The limit for the last case is a height of 1e-15 of the distance of its farthest corner,
/// the rounding error of a unit normal.
///
/// Source: Lambert, Photometria (1760); Baum, Rushmeier and Winget, Improving radiosity solutions through the use of
/// analytically determined form-factors (1989).
double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal, std::span<const glm::dvec3> polygon,
                      double absoluteError = 0);

}  // namespace hemitex::reference
