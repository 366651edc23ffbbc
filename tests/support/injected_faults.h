/// Faults injected into the simulated device, whose other errors stay within its profile. They are written apart from
/// the faults that a diagnosis draws.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/simulated_device.h"

namespace hemitex::tests {

using Buffers = std::vector<raster::ItemBuffer>;

/// All faces of a vector.
Buffers drawAll(const SimulatedDevice& device, const reference::TestVector& vector);

/// A fault, and a vector that shows it.
struct Injection {
  std::string fault, vector;  ///< their names
  std::function<Buffers(const reference::TestVector&, SimulatedDevice)> draw;
  reference::DeviceProfile profile = {};  ///< of the device; it must exclude the effect of the fault
};

/// At least one injection for each fault that a diagnosis knows.
std::vector<Injection> injectedFaults();

}  // namespace hemitex::tests
