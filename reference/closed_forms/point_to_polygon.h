/// The form factor from a point to a polygon: Lambert's contour integral.
///
/// With r_i the vectors from the point to the corners, which follow each other counter-clockwise as seen from the point
/// (the polygon faces it), and n the normal there,
///
///   F = 1/(2 pi) sum_i theta_i n . (r_i+1 x r_i) / |r_i+1 x r_i|,
///
/// where theta_i is the angle between the two, by atan2(|r_i+1 x r_i|, r_i . r_i+1). The part of the polygon
/// below the horizon is cut off; where the contour then runs along the horizon, the term is that angle itself.
///
/// The terms are as large as the polygon's angular size and add up to as little as its projected solid angle, so a
/// bound of the rounding is summed beside them. Where that is more than 1e-10 of the sum (a polygon that the point sees
/// narrower than about 2e-5 of its distance, for its width or its slant, or that is as little above the horizon) the
/// sum is taken again in 50 digits, at a thousand times the cost.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace hemitex::reference {

/// From an element of area at `point`, facing along the unit vector `normal`, to a convex planar polygon that winds
/// counter-clockwise in front; blockers are not looked at. The relative error is below 1e-9 for the numbers as given;
/// where `absoluteError` is above 0, an error below that is small enough, too, and many digits are seldom asked for.
///
/// 0 for a polygon that shows its back, for one that has the point in its plane (also where the point touches it), and
/// for one that rises above the horizon by no more than 1e-15 of the distance of its farthest corner: that is what the
/// rounding of a unit normal amounts to.
///
/// Source: Lambert, Photometria (1760); Baum, Rushmeier and Winget, Improving radiosity solutions through the use of
/// analytically determined form-factors (1989).
double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal, std::span<const glm::dvec3> polygon,
                      double absoluteError = 0);

}  // namespace hemitex::reference
