/// The form factor from polygon to polygon, nothing between them.
///
/// Both polygons are first cut to the part that is in front of the other's plane; let A_f and A_t be what is left, and
/// A the whole area of the first. Then one of two rules, whichever the distance asks for:
///
/// - *Apart*: where the smaller polygon is at least its own size away from the other, the form factor from a point
///   (point_to_polygon.h) is smooth over it, and Gauss' rule over its triangles, 10 x 10 points each, averages it to
///   1e-12. Every term is positive, so nothing cancels; by reciprocity it does not matter which of the two is smaller.
/// - *Near* or touching: Stokes' theorem turns the two areas into their contours,
///
///     A F = 1/(2 pi) sum_ij d_i . d_j  int int ln |x_i(s) - x_j(t)| ds dt
///
///   over the pairs of edges, d their unit directions, each polygon counter-clockwise in front. The inner integral is
///   closed; the outer one is cut where its integrand is sharp, at the points nearest to the other edge's ends and to
///   its line, and each part goes to the double exponential rule (tanh-sinh), which puts up with the logarithms that
///   stay at its ends: shared edges and corners, gaps of 1e-6. What the rule says its error is, and the rounding, are
///   summed; above 1e-10 of the sum (slivers) all is done again in 34 digits, at a thousand times the cost.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace hemitex::reference {

/// The share of the flux leaving `from` that reaches `to`, blockers not looked at: two convex planar polygons that wind
/// counter-clockwise in front and do not pass through each other. The relative error is below 1e-9 for the numbers as
/// given. What rises no more than 1e-13 of the polygons' extent above the other's plane counts as in it: 0 for polygons
/// that are coplanar but for rounding, and for those that show each other their backs.
///
/// Source of the contour integral: Sparrow, A new and simpler formulation for radiative angle factors (1963); its
/// closed form, which is not used here: Schroeder and Hanrahan, On the form factor between two polygons (1993).
double polygonToPolygon(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

}  // namespace hemitex::reference
