/// Counts of passed samples on real devices, whose blend units add no integers: each fragment adds 1 to a binary32
/// number, which is exact up to 2^24.
#pragma once

#include <bit>

#include "raster/interface/face.h"

namespace hemitex::reference {

/// Makes integers of the binary32 numbers that a target of counts holds.
inline void readCounts(raster::ItemBuffer& buffer) {
  for (raster::ItemId& id : buffer.ids) id = static_cast<raster::ItemId>(std::bit_cast<float>(id));
}

}  // namespace hemitex::reference
