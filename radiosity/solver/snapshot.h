/// A solution between two shots, from which it goes on with the same bits. Splits of patches are stored as calls, and
/// made again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/solver/shooting_state.h"

namespace hemitex::radiosity {

/// A call of PatchSplit. One that leaves the patch whole counts too: it chooses the resolution of its hemicube.
struct SplitCall {
  std::uint64_t patch = 0;  ///< 64 bits wide, so that no byte of the structure is padding
  double weight = 0;
};

struct Snapshot {
  int shots = 0;
  std::vector<SplitCall> splits = {};  ///< in the order of the calls
  BandTable absorbedByBacks = {};      ///< see Solution; in bands
  SavedShots state = {};
};

/// The snapshot as bytes: in three bands 24 per element, 88 per patch.
std::string toBytes(const Snapshot& snapshot);
/// Reads the bytes of one snapshot from the start of `bytes` and removes them there. Throws InputError if they are too
/// few.
Snapshot takeSnapshot(std::string_view& bytes);

}  // namespace hemitex::radiosity
