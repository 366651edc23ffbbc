/// Checkpoints of `hemitex solve`: a file from which a later run goes on and ends with the same bytes.
///
/// A run consists of one or more solutions: --max-error and --adaptive solve several times. The file holds the last
/// snapshot of each solution so far, and the hashes of the scene and of the settings. It is replaced in one step, so
/// that a run killed at any moment leaves a complete one.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/staging.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

struct LongRunOptions {
  std::filesystem::path checkpoint;  ///< written if not empty
  std::filesystem::path resume;      ///< read if not empty
  double every = 60;                 ///< seconds
  bool isForPrograms = false;        ///< progress as lines of JSON
};

/// What a checkpoint belongs to.
struct CheckpointOwner {
  std::string version;          ///< of hemitex
  std::string scene, settings;  ///< hashes
};

/// The bytes of a checkpoint: one text per solution.
std::string checkpointBytes(const CheckpointOwner& owner, const std::vector<std::string>& snapshots);
/// Reads what checkpointBytes wrote. Throws InputError for bytes that are damaged or belong to another owner.
std::vector<std::string> readCheckpoint(std::string_view bytes, const CheckpointOwner& owner);

class Checkpoint {
 public:
  /// `settings` is text that is equal for equal settings, and `inputs` are the files that the run reads. Throws
  /// InputError for a file to resume that is damaged or belongs to another version, scene or other settings, and for a
  /// file that cannot be written (see Staging), or that is there and is no checkpoint.
  Checkpoint(const LongRunOptions& options, const radiosity::Scene& scene, const std::string& settings,
             const std::set<std::filesystem::path>& inputs);

  /// Begins the next solution of the run. Returns the snapshot from which it goes on; nothing at its start.
  std::optional<radiosity::Snapshot> begin();
  /// Call this after each shot. Writes the file if it is time to, and if the run stops here.
  void update(const radiosity::Step& step, bool isStopping);

 private:
  using Clock = std::chrono::steady_clock;

  void read(const std::filesystem::path& file);
  void write();

  LongRunOptions options_;
  CheckpointOwner owner_;
  std::optional<Staging> staging_;      ///< of the file that is written
  std::vector<std::string> snapshots_;  ///< bytes, one per solution so far; empty before its first
  std::size_t begun_ = 0;               ///< number of solutions that this run has begun
  Clock::time_point written_ = Clock::now();
};

}  // namespace hemitex::cli
