/// Parallel runs, as mpirun and srun start them. They start a process per rank and tell each its rank by environment
/// variables. So a process knows its rank before it loads MPI.
#pragma once

#include <optional>
#include <string>

#include "radiosity/ranks/messenger.h"

namespace hemitex::cli {

/// The rank of this process if it was started with other ranks.
std::optional<int> launchedRank();

/// From now on, nothing that this process prints is seen.
void silence();

/// Reports an error of this rank to rank 0, and waits until rank 0 ends all ranks.
[[noreturn]] void reportToWriter(radiosity::Messenger& ranks, int exitCode, const std::string& text);

}  // namespace hemitex::cli
