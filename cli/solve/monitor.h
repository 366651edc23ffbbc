/// What accompanies the solutions of a run: the progress on the terminal, checkpoints, the convergence curve, and the
/// end by a signal.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "cli/common/console.h"
#include "cli/common/interruption.h"
#include "cli/report/solved_page.h"
#include "cli/solve/checkpoint.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

class Monitor {
 public:
  /// `console` must outlive this object. See Checkpoint for the other arguments and for errors.
  Monitor(Console& console, const LongRunOptions& options, const radiosity::Scene& scene, const std::string& settings,
          const std::set<std::filesystem::path>& inputs = {});

  Console& console() { return console_; }

  /// Begins the next solution of the run. Returns the snapshot from which it goes on; nothing at its start.
  std::optional<radiosity::Snapshot> begin() { return checkpoint_.begin(); }
  /// Shows each shot of a solution, adds it to `convergence`, writes checkpoints, and ends the solution after a signal.
  /// The time of the curve starts now. The arguments must outlive the result.
  radiosity::Progress progressOf(const radiosity::SolverSettings& settings, Convergence& convergence);

 private:
  void show(const radiosity::SolverSettings& settings, const radiosity::Step& step, const Convergence& convergence);

  Console& console_;
  bool isForPrograms_;
  std::chrono::steady_clock::time_point shown_;
  Checkpoint checkpoint_;
  std::optional<LongRun> run_;  ///< from the first shot on; before it there is nothing to write after a signal
};

}  // namespace hemitex::cli
