/// A failing test vector made small enough to step through: one pixel, and the fewest triangles that leave it the same
/// kind of error.
///
/// The device is not at hand, only what it drew: its item ID at a pixel stays, while triangles are taken from the draw
/// list for as long as the rules still demand the item ID that they demanded, the judge still calls the device's item
/// ID an error, and the error is of the same kind. Triangles go by halves, then quarters, down to single ones, until
/// none can go (delta debugging: Zeller and Hildebrandt, Simplifying and Isolating Failure-Inducing Input, 2002).
#pragma once

#include "reference/verdict/error_pixel.h"

namespace hemitex::reference {

struct MinimalFailure {
  TestVector vector;  ///< one face, whose scissor rectangle is one pixel of the viewport it had
  ErrorPixel error;   ///< in that vector
  raster::ItemBuffer expected, found;
};

/// The verdict has errors. Of 64 spread evenly over them the most frequent kind is kept (of equals, the first in
/// ErrorKind); of the first eight of that kind the one that needs the fewest triangles wins. A pixel on the inner edges
/// of a mesh may need all triangles that meet there; elsewhere two are enough: the one that is visible, and one whose
/// draw gives the device's item ID.
MinimalFailure minimize(const TestVector& vector, const Verdict& verdict, const DeviceProfile& profile);

}  // namespace hemitex::reference
