/// A failing test vector reduced to one pixel and the fewest triangles that keep its kind of error, small enough for a
/// debugger.
///
/// The device itself is not available, only its item buffers. So its item ID at a pixel is fixed, and minimize removes
/// triangles from the draw list. A removal is valid while the expected item ID stays the same, the verdict stays an
/// error, and the kind of the error stays the same. With the device at hand, reduce (reduction.h) makes vectors
/// smaller.
#pragma once

#include "reference/conformance/verdict/error_pixel.h"

namespace hemitex::reference {

struct MinimalFailure {
  TestVector vector;  ///< one face whose scissor rectangle is one pixel of its viewport
  ErrorPixel error;   ///< in that vector
  raster::ItemBuffer expected, found;
};

/// Requires a verdict with errors. It samples 64 errors evenly, takes the most frequent kind (of equals, the first in
/// ErrorKind), and minimizes the first eight of that kind. The result with the fewest triangles wins. A pixel on the
/// inner edges of a mesh may need all triangles that meet there. Elsewhere two are enough: the visible one, and one
/// whose draw produces the item ID of the device.
MinimalFailure minimize(const TestVector& vector, const Verdict& verdict, const DeviceProfile& profile);

}  // namespace hemitex::reference
