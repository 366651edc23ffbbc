/// The single plane (Recker, George and Greenberg 1990): one square face over a point, wide enough for most of the
/// light. One view instead of five; what passes below its edges is not seen at all.
///
/// A square of half-width t at distance 1, centred over the point, is the form factor of four rectangles whose corner
/// is on the normal: with c = t / sqrt(1 + t^2), the share 4/pi c atan(c).
///
///     t         1      2      3      4      6      8      12     16
///     captured  0.554  0.831  0.917  0.951  0.978  0.987  0.994  0.997
///
/// What is lost falls with 1/t^2, but pixels grow with t. Of rows of the Cornell box, the sum of all errors (see
/// reference::distanceToTruth), what is lost included, against the width, at a quarter, once and four times the pixels
/// of a hemicube with R = 256:
///
///     t             1     2     3     4     6     8     12
///     220 x 220     0.37  0.16  0.12  0.12  0.16  0.21  0.34
///     442 x 442     0.37  0.14  0.08  0.06  0.07  0.09  0.14
///     886 x 886     0.36  0.14  0.07  0.05  0.03  0.04  0.05
///
/// A hemicube's sums are 0.031, 0.012 and 0.004 there: the plane is the fastest and the least exact of projections.
#pragma once

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

/// Near the best for all of these, and a power of two, so that rows are exact.
inline constexpr double planeHalfWidth = 4;

/// A plane of resolution x resolution pixels at a distance of 1, from -halfWidth to halfWidth along the projection's
/// own axes. Shares are the integrals over each pixel's solid angle, so `captured` is what the sum over the square is.
/// `resolution` is even, 2 to 4096; `halfWidth` above 0, at most 64.
Projection singlePlane(int resolution, double halfWidth = planeHalfWidth);

}  // namespace hemitex::radiosity
