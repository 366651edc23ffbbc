/// A failing test vector made small enough for a debugger. While a device is at hand, `reduce` draws every smaller
/// vector again. Without it, `minimize` takes what the device drew at a pixel.
///
/// Parts are removed in runs of halves, then of quarters, down to single ones (delta debugging: Zeller and Hildebrandt,
/// Simplifying and Isolating Failure-Inducing Input, 2002).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/conformance/verdict/error_pixel.h"

namespace hemitex::reference {

/// Removes triangles until each one is needed for `fails`. Requires that all of them together fail.
std::vector<DrawnTriangle> fewestTriangles(std::vector<DrawnTriangle> triangles,
                                           const std::function<bool(std::span<const DrawnTriangle>)>& fails);

/// Removes faces, triangles, rows and columns of pixels, rows and columns of index maps, and vertices, as long as
/// `fails` stays true: until no single one of them can go. Two vertices become one by taking the place of the other.
/// Requires that `vector` fails. The viewports keep their size. It calls `fails` at most `maxRuns` times, and then
/// returns the smallest vector so far.
TestVector reduce(TestVector vector, const std::function<bool(const TestVector&)>& fails, std::size_t maxRuns);

/// A failure at one pixel with the fewest triangles that keep its kind of error.
struct MinimalFailure {
  TestVector vector;  ///< one face whose scissor rectangle is one pixel of its viewport
  ErrorPixel error;   ///< in that vector
  raster::ItemBuffer expected, found;
};

/// Removes triangles while the expected item ID stays the same, the verdict stays an error, and the kind of the error
/// stays the same. Requires a verdict with errors. It samples 64 errors evenly, takes the most frequent kind (of
/// equals, the first in ErrorKind), and minimizes the first eight of that kind. The result with the fewest triangles
/// wins. A pixel on the inner edges of a mesh may need all triangles that meet there. Elsewhere two are enough: the
/// visible one, and one whose draw produces the item ID of the device.
MinimalFailure minimize(const TestVector& vector, const Verdict& verdict, const DeviceProfile& profile);

}  // namespace hemitex::reference
