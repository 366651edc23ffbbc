/// What SIGINT and SIGTERM do. Without a long run they end the program at once, with one line, and its temporary
/// folders are removed. A long run is asked to stop by the first signal; the second ends it at once.
#pragma once

#include <atomic>
#include <optional>

namespace hemitex::cli {

/// Starts to wait for signals in a thread of its own. Call this before any other thread starts. Does nothing for a
/// signal that the caller of the program has set to be ignored.
void watchSignals();

/// While such an object exists, the first signal is only noted.
class LongRun {
 public:
  LongRun();
  ~LongRun();
  LongRun(const LongRun&) = delete;
  LongRun& operator=(const LongRun&) = delete;

  /// Becomes true when a signal asks the run to stop.
  static const std::atomic<bool>& isStopping();
};

/// The exit code of a run that a signal stopped: 130 for SIGINT, 143 for SIGTERM; nothing if none did.
std::optional<int> stoppedExitCode();

}  // namespace hemitex::cli
