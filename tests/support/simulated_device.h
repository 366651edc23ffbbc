/// A device that is right but not exact: it draws by the raster rules with errors as large as its profile allows, drawn
/// at random from a seed. It is written by brute force, pixel by pixel, and shares with the rules only the vertex stage
/// and the clipping that it disturbs.
#pragma once

#include <functional>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/setup/vertex_stage.h"
#include "reference/verdict/device_profile.h"

namespace hemitex::tests {

struct SimulatedDevice {
  reference::DeviceProfile profile;  ///< how large its errors are
  std::uint32_t seed = 0;
  bool cutsAtView = false;  ///< clips at the sides of the view instead of the guard band

  // Faults: a device is right where they have their defaults. A function that is empty does what is right.
  double shift = 0;                                   ///< of all vertices along the rows, in sub-pixels
  double texelShift = 0;                              ///< of all texture coordinates, in texels
  std::function<void(raster::ViewVertex&)> vertex{};  ///< changes what the vertex stage gives
  bool bottomRight = false;                           ///< gives samples on edges to the wrong triangle
  glm::dvec2 sample{128, 128};                        ///< of coverage and depth, in sub-pixels
  glm::dvec2 shading{128, 128};                       ///< of texture coordinates
  bool affine = false;                                ///< interpolates them without perspective
  std::function<bool(double, double)> passes{};       ///< of a depth and the one stored
  std::function<raster::ItemId(const raster::IndexMap&, const glm::dvec2&)> fetch{};  ///< at (u N, v M)
  std::function<raster::ItemId(raster::ItemId, raster::ItemId)> blend{};              ///< of offset and texel
  std::function<raster::ItemId(raster::ItemId, raster::ItemId)>
      store{};  ///< of the target's item ID and the fragment's
};

raster::ItemBuffer drawOn(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face);

}  // namespace hemitex::tests
