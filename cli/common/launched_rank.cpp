#include "cli/common/launched_rank.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "cli/common/numbers.h"

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

/// Open MPI's mpirun, PMI (MPICH, srun --mpi=pmi2) and PMIx (srun --mpi=pmix). Slurm's own variables are no evidence:
/// they are also set for the script of a job, which runs once.
constexpr std::array launchers{Launcher{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                               Launcher{"PMI_RANK", "PMI_SIZE"}, Launcher{"PMIX_RANK", nullptr}};

}  // namespace

std::optional<int> launchedRank() {
  for (const Launcher& launcher : launchers)
    if (const std::optional<int> rank = numberIn(launcher.rank))
      return numberIn(launcher.ranks) == 1 ? std::nullopt : rank;
  return std::nullopt;
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
