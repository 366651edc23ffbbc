/// Starts other programs, without a shell.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
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

/// A program in a process group of its own. Several threads may each have some.
class ChildProcess {
 public:
  /// What is connected to stdin and stdout: nothing, or this program, which asks and gets answers.
  enum class Talk { None, Lines };

  /// Starts the program words[0] with the other words as arguments. Throws InputError if that fails.
  ChildProcess(const std::vector<std::string>& words, Talk talk);
  /// As finish, with one second.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes the line `request` to the stdin of a program with Talk::Lines. Returns the next line of its stdout that
  /// `isAnswer`; other lines are ignored. Nothing if the program ends, after `seconds`, or when `isCancelled` becomes
  /// true: then only finish is left to do.
  std::optional<std::string> ask(const std::string& request,
                                 const std::function<bool(const std::string& line)>& isAnswer, double seconds,
                                 const std::atomic<bool>* isCancelled = nullptr);

  /// The last lines of stderr since the last request.
  std::vector<std::string> lastLines() const;

  /// Closes stdin and waits for the end of the program. After `seconds`, or when `isCancelled` becomes true, its
  /// process group gets SIGTERM, and one second later SIGKILL. Its process group also ends when the program ends. Call
  /// it once.
  ProcessResult finish(double seconds, const std::atomic<bool>* isCancelled = nullptr);

 private:
  struct Streams;
  std::unique_ptr<Streams> streams_;  ///< null after the end
  pid_t process_ = 0;
};

/// Starts a program that reads nothing and whose stdout is ignored, and finishes it.
ProcessResult runProcess(const std::vector<std::string>& words, double seconds,
                         const std::atomic<bool>* isCancelled = nullptr);

/// Starts a program in a session of its own, so that it outlives this program. Waits at most `wait` for its end. False
/// if it cannot be started or failed in this time.
bool startDetached(const std::vector<std::string>& words, std::chrono::milliseconds wait);

}  // namespace hemitex::reference
