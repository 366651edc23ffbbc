#include "reference/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <sstream>
#include <system_error>
#include <thread>

#include "raster/base/input_error.h"

extern char** environ;

// Not by Boost.Process 1.74: its pipes are inherited by programs that other threads start at the same time, and waiting
// with a time limit replaces the handler of SIGCHLD of the whole program.
namespace hemitex::reference {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t maxLines = 10;
constexpr std::size_t maxBytes = 4096;
constexpr std::chrono::milliseconds checkInterval{5};
constexpr std::chrono::seconds timeToTerminate{1};

/// The read end of a pipe, and the last bytes that came through it. Reading never waits.
class StreamEnd {
 public:
  StreamEnd() {
    // No other program that starts at the same time inherits the pipe.
    if (pipe2(ends_, O_CLOEXEC) != 0 || fcntl(ends_[0], F_SETFL, O_NONBLOCK) != 0)
      throw std::system_error(errno, std::generic_category(), "a pipe cannot be made");
  }
  ~StreamEnd() {
    closeEnd(ends_[0]);
    closeEnd(ends_[1]);
  }
  StreamEnd(const StreamEnd&) = delete;
  StreamEnd& operator=(const StreamEnd&) = delete;

  int writeEnd() const { return ends_[1]; }
  void closeWriteEnd() { closeEnd(ends_[1]); }

  /// Waits at most this long for bytes and keeps the last ones.
  void read(std::chrono::milliseconds wait) {
    pollfd request{ends_[0], POLLIN, 0};  // poll only waits if the stream is closed
    poll(&request, 1, static_cast<int>(wait.count()));
    char bytes[maxBytes];
    ssize_t count = 0;
    while (ends_[0] >= 0 && (count = ::read(ends_[0], bytes, sizeof bytes)) > 0) {
      text_.append(bytes, static_cast<std::size_t>(count));
      if (text_.size() > maxBytes) text_.erase(0, text_.size() - maxBytes);
    }
    if (count == 0) closeEnd(ends_[0]);
  }

  std::vector<std::string> lastLines() const {
    std::vector<std::string> lines;
    std::istringstream stream(text_);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.size() > maxLines) lines.erase(lines.begin(), lines.end() - maxLines);
    return lines;
  }

 private:
  static void closeEnd(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }

  int ends_[2] = {-1, -1};
  std::string text_;
};

/// Returns the error code of a program that cannot be started, else 0. `errorStream` is an open file for stderr; -1
/// means none. `group` is POSIX_SPAWN_SETPGROUP for a process group of its own, or POSIX_SPAWN_SETSID for a session of
/// its own, so that the new program outlives this one.
///
/// The new program has no stdin and no stdout, which would mix with results. Signals have their default effect in it:
/// this program blocks or ignores some.
int start(const std::vector<std::string>& words, int errorStream, short group, pid_t& process) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (errorStream >= 0)
    posix_spawn_file_actions_adddup2(&actions, errorStream, STDERR_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, static_cast<short>(group | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  const int error = posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Leaves the ended process in place, so that its process group keeps its number.
bool hasEnded(pid_t process) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

/// Returns false if the process still runs after `time`.
bool waitForEnd(pid_t process, std::chrono::duration<double> time, StreamEnd& stream,
                const std::atomic<bool>* isCancelled) {
  const auto begin = Clock::now();
  while (!hasEnded(process)) {
    if (Clock::now() - begin >= time || (isCancelled && *isCancelled)) return false;
    stream.read(checkInterval);
  }
  return true;
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& words, double seconds, const std::atomic<bool>* isCancelled) {
  StreamEnd stream;
  pid_t process = 0;
  if (const int error = start(words, stream.writeEnd(), POSIX_SPAWN_SETPGROUP, process))
    throw raster::InputError(
        "the program \"" + words[0] + "\" cannot be started: " + std::generic_category().message(error),
        "correct the command of the device");
  stream.closeWriteEnd();
  ProcessResult result;
  result.isTimedOut = !waitForEnd(process, std::chrono::duration<double>(seconds), stream, isCancelled);
  if (result.isTimedOut) {
    kill(-process, SIGTERM);
    waitForEnd(process, timeToTerminate, stream, nullptr);
  }
  kill(-process, SIGKILL);  // what the program left behind, too
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  stream.read(std::chrono::milliseconds(0));
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  result.lastLines = stream.lastLines();
  return result;
}

bool startDetached(const std::vector<std::string>& words, std::chrono::milliseconds wait) {
  pid_t process = 0;
  if (start(words, -1, POSIX_SPAWN_SETSID, process) != 0) return false;
  for (const auto begin = Clock::now(); Clock::now() - begin < wait; std::this_thread::sleep_for(checkInterval)) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) == process) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return true;
}

}  // namespace hemitex::reference
