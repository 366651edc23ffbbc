/// The form factor between two polygons without blockers.
///
/// Each polygon is first clipped to the part in front of the other's plane. Let A_f and A_t be the remaining areas, and
/// A the whole area of the first polygon. The distance then selects one of two rules:
///
/// - *Apart*: the smaller polygon is at least its own size away from the other. Then the form factor from a point
///   (point_to_polygon.h) is smooth over it. Gauss' rule averages it to 1e-12, with 10 x 10 points per triangle, and
///   down to 4 x 4 for distances above 40 sizes. All terms are positive, so that nothing cancels. By reciprocity either
///   polygon may be the smaller one. Where a larger error is asked for, fewer points do.
/// - *Near* or touching: Stokes' theorem converts the two areas to their contours,
///
///     A F = 1/(2 pi) sum_ij d_i . d_j  int int ln |x_i(s) - x_j(t)| ds dt
///
/// over the pairs of edges. Here d are their unit directions, and each polygon is counter-clockwise in front. Pairs at
/// a right angle add nothing. For parallel edges the integral has a closed form. Otherwise the inner one has. The outer
/// one is by Gauss' rule where the edges are apart. Else it is divided where its integrand is not smooth: at the points
/// nearest to the other edge's ends and to its line. Each part is integrated with the double exponential rule
/// (tanh-sinh), which can handle logarithms at its ends: shared edges and corners, gaps of 1e-6. The error estimates of
/// the rules and the rounding errors are summed. If they are above what is asked for, the result is computed again with
/// the smallest errors of the rules, and then (slivers) in 34 digits, which takes a thousand times as long.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace hemitex::reference {

/// The error that a result may have: relative, or absolute where that is more.
struct FormFactorAccuracy {
  double relative = 1e-10;  ///< at least 1e-10
  double absolute = 0;      ///< above 0, tiny form factors, whose digits cancel, take no wide numbers
};

/// The share of the flux leaving `from` that reaches `to`, without blockers. Both are convex planar polygons that wind
/// counter-clockwise in front and do not intersect. The relative error is below 1e-9 for the given numbers, or ten
/// times `accuracy`. Corners within 1e-13 of the polygons' extent of the other's plane count as in the plane. So the
/// result is 0 for polygons that are coplanar up to rounding, and for those that face away from each other.
///
/// Source of the contour integral: Sparrow, A new and simpler formulation for radiative angle factors (1963). Its
/// closed form for edges that are not parallel, not used here: Schroeder and Hanrahan, On the form factor between two
/// polygons (1993).
double polygonToPolygon(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to,
                        const FormFactorAccuracy& accuracy = {});

}  // namespace hemitex::reference
