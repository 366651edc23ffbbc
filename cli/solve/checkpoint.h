/// Checkpoints of `hemitex solve`: a file from which a later run goes on and ends with the same bytes.
///
/// A run consists of one or more solutions: --max-error and --adaptive solve several times. The file holds the last
/// snapshot of each solution so far, and the hashes of the scene and of the settings. It is replaced in one step, so
/// that a run killed at any moment leaves a complete one.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

struct LongRunOptions {
  std::filesystem::path checkpoint;  ///< written if not empty
  std::filesystem::path resume;      ///< read if not empty
  double every = 60;                 ///< seconds
  bool isForPrograms = false;        ///< progress as lines of JSON
};

class Checkpoint {
 public:
  /// `settings` is text that is equal for equal settings. Throws InputError for a file to resume that is damaged or
  /// belongs to another scene or other settings, and for a file that cannot be written.
  Checkpoint(const LongRunOptions& options, const radiosity::Scene& scene, const std::string& settings);

  /// Begins the next solution of the run. Returns the snapshot from which it goes on; nothing at its start.
  std::optional<radiosity::Snapshot> begin();
  /// Call this after each shot. Writes the file if it is time to, and if the run stops here.
  void update(const radiosity::Step& step, bool isStopping);

 private:
  using Clock = std::chrono::steady_clock;

  void read(const std::filesystem::path& file);
  void write() const;

  LongRunOptions options_;
  std::string scene_, settings_;        ///< hashes
  std::vector<std::string> snapshots_;  ///< bytes, one per solution so far; empty before its first
  std::size_t begun_ = 0;               ///< number of solutions that this run has begun
  Clock::time_point written_ = Clock::now();
};

}  // namespace hemitex::cli
