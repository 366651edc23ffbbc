/// Faults injected into the simulated device, whose errors stay as large as its profile allows. They share nothing with
/// the faults that a diagnosis draws.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reference/vectors/vector_file.h"
#include "tests/support/simulated_device.h"

namespace hemitex::tests {

using Buffers = std::vector<raster::ItemBuffer>;

/// All faces of a vector.
Buffers drawAll(const SimulatedDevice& device, const reference::TestVector& vector);

/// A way to go wrong, on a vector where it shows.
struct Injection {
  std::string fault, vector;  ///< their names
  std::function<Buffers(const reference::TestVector&, SimulatedDevice)> draw;
};

/// Every fault that a diagnosis knows, once at least.
std::vector<Injection> injectedFaults();

}  // namespace hemitex::tests
