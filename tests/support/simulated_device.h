/// A simulated device with permitted errors: a staged device (staged_device.h) with random errors within a profile in
/// its stages.
#pragma once

#include <functional>

#include "reference/conformance/diagnosis/staged_device.h"
#include "reference/conformance/verdict/device_profile.h"

namespace hemitex::tests {

/// How a device evaluates u = (u/w) / (1/w).
enum class Interpolation {
  Exact,          ///< in double precision
  Barycentric32,  ///< in binary32, with the weights of the corners
  Planes32,       ///< in binary32, with plane equations relative to the first corner
};

struct SimulatedDevice {
  reference::DeviceProfile profile;  ///< bounds of its errors
  std::uint32_t seed = 0;
  bool cutsAtView = false;  ///< clips at the sides of the view instead of the guard band
  Interpolation interpolation = Interpolation::Exact;

  // Faults: with their defaults the device is right. An empty function means the right behaviour.
  double shift = 0;                                   ///< of all vertices along the rows, in sub-pixels
  double texelShift = 0;                              ///< of all texture coordinates, in texels
  std::function<void(raster::ViewVertex&)> vertex{};  ///< changes the result of the vertex stage
  bool bottomRight = false;                           ///< gives samples on edges to the wrong triangle
  raster::SnappedPoint sample{128, 128};              ///< of coverage and depth, in sub-pixels
  raster::SnappedPoint shading{128, 128};             ///< of texture coordinates
  bool affine = false;                                ///< interpolates them without perspective
  std::function<bool(double, double)> passes{};       ///< of a depth and the stored one
  std::function<raster::ItemId(const raster::IndexMap&, const glm::dvec2&)> fetch{};  ///< at (u N, v M)
  std::function<raster::ItemId(raster::ItemId, raster::ItemId)> blend{};              ///< of offset and texel
  std::function<raster::ItemId(raster::ItemId, raster::ItemId)>
      store{};  ///< of the target's item ID and the fragment's
};

/// The device's stages for lists with the depths of one. It goes on with its random errors from call to call.
reference::StagedDevice stagedDeviceOf(const SimulatedDevice& device, const raster::DrawList& list = {});

raster::ItemBuffer drawOn(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face);

}  // namespace hemitex::tests
