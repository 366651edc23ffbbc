/// Parallel runs, as mpirun and srun start them. They start a process per rank and tell each its rank by environment
/// variables. So a process knows its rank before it loads MPI.
#pragma once

#include <optional>
#include <string>

#include "radiosity/ranks/messenger.h"

namespace hemitex::cli {

/// The place of a process in a parallel run.
struct LaunchedRank {
  int rank = 0;
  std::optional<int> ranks;  ///< nothing if the launcher does not tell
};

/// The rank of this process if it was started with other ranks.
std::optional<LaunchedRank> launchedRank();

/// Throws InputError if MPI has other ranks than the launcher. This is so where the launcher belongs to another MPI.
void requireSameRanks(const radiosity::Messenger& ranks, const LaunchedRank& launched);

/// From now on, nothing that this process prints is seen.
void silence();

/// Reports an error of this rank to rank 0, and waits until rank 0 ends all ranks.
[[noreturn]] void reportToWriter(radiosity::Messenger& ranks, int exitCode, const std::string& text);

}  // namespace hemitex::cli
