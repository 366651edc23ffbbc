/// Starts other programs, without a shell. They read nothing from stdin, and what they write to stdout is ignored.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

namespace hemitex::reference {

struct ProcessResult {
  int exitCode = 0;
  int signal = 0;  ///< that ended the process; 0 if it exited
  bool isTimedOut = false;
  std::vector<std::string> lastLines = {};  ///< of stderr, at most 10

  bool hasSucceeded() const { return exitCode == 0 && signal == 0 && !isTimedOut; }
};

/// Starts the program words[0] with the other words as arguments, and waits for its end. After `seconds` its process
/// group gets SIGTERM, and one second later SIGKILL. Its process group also ends when the program ends, and when
/// `isCancelled` becomes true. Several threads may call it at a time. Throws InputError if the program cannot be
/// started.
ProcessResult runProcess(const std::vector<std::string>& words, double seconds,
                         const std::atomic<bool>* isCancelled = nullptr);

/// Starts a program in a session of its own, so that it outlives this program. Waits at most `wait` for its end. False
/// if it cannot be started or failed in this time.
bool startDetached(const std::vector<std::string>& words, std::chrono::milliseconds wait);

}  // namespace hemitex::reference
