/// The memory of a whole run, estimated before it starts.
#pragma once

#include "cli/solve/options.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// Throws InputError, with the number, if the pictures of the result could not be written, or if the program, the
/// scene, its elements and the rows that the cache may hold do not fit into the free memory (see
/// raster/base/memory_budget.h). docs/performance.md states how the bytes of each were measured.
void requireMemoryOfRun(const radiosity::Scene& scene, const SolveOptions& options);

}  // namespace hemitex::cli
