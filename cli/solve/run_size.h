/// The size of a run, known before it starts: the number of elements and the memory that they and the triangles take. A
/// run that would be very large or would not fit into memory asks first.
#pragma once

#include <cstdint>
#include <optional>

#include "cli/solve/options.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

struct RunSize {
  std::uint64_t elements = 0;  ///< texels of all grids; phantoms make the true number smaller
  std::uint64_t bytes = 0;     ///< peak memory, estimated
};

/// The size from the grids, surfaces and triangles. docs/performance.md states how the bytes of each were measured.
RunSize runSize(const radiosity::Scene& scene, const SolveOptions& options);

/// Throws InputError, with the number and the option to insist, for more than 2^24 elements or more bytes than are
/// free.
void requireAffordable(const RunSize& size, std::optional<std::uint64_t> freeBytes);

/// The bytes that programs can still use without swapping; nothing where the system does not say.
std::optional<std::uint64_t> freeMemory();

}  // namespace hemitex::cli
