/// A device that is right but not exact: it draws by the raster rules with errors as large as its profile allows, drawn
/// at random from a seed. It is written by brute force, pixel by pixel, and shares with the rules only the vertex stage
/// and the clipping that it disturbs.
#pragma once

#include "raster/draw_list.h"
#include "raster/face.h"
#include "reference/device_profile.h"

namespace hemitex::tests {

struct SimulatedDevice {
  reference::DeviceProfile profile;  ///< how large its errors are
  std::uint32_t seed = 0;
  bool cutsAtView = false;   ///< clips at the sides of the view instead of the guard band
  bool bottomRight = false;  ///< gives samples on edges to the wrong triangle
  double shift = 0;          ///< of all vertices along the rows, in sub-pixels: a fault
  double texelShift = 0;     ///< of all texture coordinates, in texels: a fault
};

raster::ItemBuffer drawOn(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face);

}  // namespace hemitex::tests
