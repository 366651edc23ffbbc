/// The single plane (Recker, George and Greenberg 1990): one square face over a point, wide enough for most of the
/// light. It needs one view instead of five. Light below its edges is lost.
///
/// A square of half-width t at distance 1, centred over the point, has the form factor of four rectangles with a corner
/// on the normal. With c = t / sqrt(1 + t^2), the share is 4/pi c atan(c):
///
///     t         1      2      3      4      6      8      12     16
///     captured  0.554  0.831  0.917  0.951  0.978  0.987  0.994  0.997
///
/// The lost share falls with 1/t^2, but pixels grow with t. The next table shows rows of the Cornell box: the sum of
/// all errors (see reference::distanceToTruth), including the lost share, by width. The resolutions have a quarter,
/// once and four times the pixels of a hemicube with R = 256:
///
///     t             1     2     3     4     6     8     12
///     220 x 220     0.37  0.16  0.12  0.12  0.16  0.21  0.34
///     442 x 442     0.37  0.14  0.08  0.06  0.07  0.09  0.14
///     886 x 886     0.36  0.14  0.07  0.05  0.03  0.04  0.05
///
/// The sums of a hemicube are 0.031, 0.012 and 0.004: the plane is the fastest and the least accurate projection.
#pragma once

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

/// Near the optimum for all three resolutions, and a power of two, so that the rows x, y, w are exact.
inline constexpr double planeHalfWidth = 4;

/// A plane of resolution x resolution pixels at a distance of 1, from -halfWidth to halfWidth along the axes of the
/// projection. Shares are the integrals over the solid angle of each pixel, and `captured` is their sum. `resolution`
/// is even, 2 to 4096; `halfWidth` is above 0 and at most 64.
Projection singlePlane(int resolution, double halfWidth = planeHalfWidth);

}  // namespace hemitex::radiosity
