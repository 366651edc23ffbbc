/// Draws all faces of a vector on a staged device.
#pragma once

#include <vector>

#include "reference/conformance/diagnosis/staged_device.h"

namespace hemitex::tests {

/// The item buffers of the vector's faces as the device draws them.
inline std::vector<raster::ItemBuffer> drawAll(const reference::StagedDevice& device,
                                               const reference::PlacedVector& placed) {
  std::vector<raster::ItemId> ids;
  drawOn(device, placed, [&](const raster::ItemBuffer& part) {
    ids.insert(ids.end(), part.ids.begin(), part.ids.end());
    return true;
  });
  std::vector<raster::ItemBuffer> buffers;
  auto next = ids.begin();
  for (const raster::Face& face : placed.faces) {
    buffers.emplace_back().resize(face.scissor);
    for (raster::ItemId& id : buffers.back().ids) id = *next++;
  }
  return buffers;
}

inline std::vector<raster::ItemBuffer> drawAll(const reference::StagedDevice& device,
                                               const reference::TestVector& vector) {
  return drawAll(device, placeVector(vector));
}

}  // namespace hemitex::tests
