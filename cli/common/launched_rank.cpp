#include "cli/common/launched_rank.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "cli/common/numbers.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

std::optional<int> numberIn(const char* variable) {
  const char* const text = variable != nullptr ? std::getenv(variable) : nullptr;
  return text != nullptr ? parseInteger(text) : std::nullopt;
}

/// The variables of a launcher. The number of ranks may be unknown.
struct Launcher {
  const char *rank, *ranks;
};

/// Open MPI's mpirun, PMI and PMIx (srun --mpi=pmi2 and pmix; that of MPICH is refused later). Slurm's own variables
/// are no evidence: they are also set for the script of a job, which runs once.
constexpr std::array launchers{Launcher{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                               Launcher{"PMI_RANK", "PMI_SIZE"}, Launcher{"PMIX_RANK", nullptr}};

}  // namespace

std::optional<LaunchedRank> launchedRank() {
  for (const Launcher& launcher : launchers)
    if (const std::optional<int> rank = numberIn(launcher.rank)) {
      const LaunchedRank launched{*rank, numberIn(launcher.ranks)};
      return launched.ranks == 1 ? std::nullopt : std::optional(launched);
    }
  return std::nullopt;
}

void requireSameRanks(const radiosity::Messenger& ranks, const LaunchedRank& launched) {
  if (ranks.rank() != launched.rank || ranks.ranks() != launched.ranks.value_or(ranks.ranks()))
    throw raster::InputError("the launcher's MPI is not the one that hemitex was built with",
                             "start hemitex by mpirun of Open MPI, or by srun --mpi=pmix");
}

void silence() {
  for (std::FILE* stream : {stdout, stderr})
    if (std::freopen("/dev/null", "w", stream) == nullptr) std::fclose(stream);
}

void reportToWriter(radiosity::Messenger& ranks, int exitCode, const std::string& text) {
  ranks.send(0, radiosity::MessageKind::Failed, static_cast<char>(exitCode) + text);
  while (true) {
    ranks.receive();  // lets MPI send
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace hemitex::cli
