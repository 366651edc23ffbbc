#include "reference/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
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
constexpr double timeToTerminate = 1;  // seconds

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

  void clear() { text_.clear(); }

  /// The first whole line that came, which is taken away.
  std::optional<std::string> takeLine() {
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos) return {};
    const std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
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

/// Two connected sockets. Unlike a pipe, the one that writes can report a program that no longer reads.
class SocketPair {
 public:
  SocketPair() {
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_) != 0)
      throw std::system_error(errno, std::generic_category(), "a socket cannot be made");
  }
  ~SocketPair() {
    for (const int end : ends_)
      if (end >= 0) close(end);
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;

  int readEnd() const { return ends_[0]; }
  void closeReadEnd() {
    close(ends_[0]);
    ends_[0] = -1;
  }

  /// Removes what could be sent from the beginning of the text. Never waits.
  void send(std::string& text) const {
    const ssize_t count = ::send(ends_[1], text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) text.erase(0, static_cast<std::size_t>(count));
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Open files for the streams of a program; -1 means none.
struct Files {
  int in = -1, out = -1, errors = -1;
};

/// Returns the error code of a program that cannot be started, else 0. `group` is POSIX_SPAWN_SETPGROUP for a process
/// group of its own, or POSIX_SPAWN_SETSID for a session of its own, so that the new program outlives this one. Streams
/// of this program would mix with results, so that none is inherited. Signals have their default effect in the new
/// program: this program blocks or ignores some.
int start(const std::vector<std::string>& words, const Files& files, short group, pid_t& process) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  int stream = STDIN_FILENO;
  for (const int file : {files.in, files.out, files.errors}) {
    if (file >= 0)
      posix_spawn_file_actions_adddup2(&actions, file, stream);
    else
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    ++stream;
  }
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

bool isOver(Clock::time_point begin, double seconds, const std::atomic<bool>* isCancelled) {
  return Clock::now() - begin >= std::chrono::duration<double>(seconds) || (isCancelled && *isCancelled);
}

}  // namespace

struct ChildProcess::Streams {
  std::optional<SocketPair> requests;
  std::optional<StreamEnd> answers;
  StreamEnd errors;

  /// Waits shortly for what the program writes.
  void read() {
    if (answers) answers->read(checkInterval);
    errors.read(answers ? std::chrono::milliseconds(0) : checkInterval);
  }

  /// Returns false if the process still runs after `seconds`.
  bool waitForEnd(pid_t process, double seconds, const std::atomic<bool>* isCancelled) {
    const auto begin = Clock::now();
    while (!hasEnded(process)) {
      if (isOver(begin, seconds, isCancelled)) return false;
      read();
    }
    return true;
  }
};

ChildProcess::ChildProcess(const std::vector<std::string>& words, Talk talk) : streams_(std::make_unique<Streams>()) {
  Files files{.errors = streams_->errors.writeEnd()};
  if (talk == Talk::Lines) {
    files.in = streams_->requests.emplace().readEnd();
    files.out = streams_->answers.emplace().writeEnd();
  }
  if (const int error = start(words, files, POSIX_SPAWN_SETPGROUP, process_))
    throw raster::InputError(
        "the program \"" + words[0] + "\" cannot be started: " + std::generic_category().message(error),
        "correct the command of the device");
  streams_->errors.closeWriteEnd();
  if (talk == Talk::Lines) {
    streams_->requests->closeReadEnd();
    streams_->answers->closeWriteEnd();
  }
}

ChildProcess::~ChildProcess() {
  if (streams_) finish(timeToTerminate);
}

std::optional<std::string> ChildProcess::ask(const std::string& request,
                                             const std::function<bool(const std::string& line)>& isAnswer,
                                             double seconds, const std::atomic<bool>* isCancelled) {
  const auto begin = Clock::now();
  streams_->errors.clear();
  std::string unsent = request + '\n';
  for (;;) {
    streams_->requests->send(unsent);
    const bool isLast = hasEnded(process_) || isOver(begin, seconds, isCancelled);
    streams_->read();
    while (const std::optional<std::string> line = streams_->answers->takeLine())
      if (isAnswer(*line)) return line;
    if (isLast) return {};
  }
}

std::vector<std::string> ChildProcess::lastLines() const { return streams_->errors.lastLines(); }

ProcessResult ChildProcess::finish(double seconds, const std::atomic<bool>* isCancelled) {
  const std::unique_ptr<Streams> streams = std::move(streams_);
  streams->requests.reset();
  ProcessResult result;
  result.isTimedOut = !streams->waitForEnd(process_, seconds, isCancelled);
  if (result.isTimedOut) {
    kill(-process_, SIGTERM);
    streams->waitForEnd(process_, timeToTerminate, nullptr);
  }
  kill(-process_, SIGKILL);  // what the program left behind, too
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  streams->errors.read(std::chrono::milliseconds(0));
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  result.lastLines = streams->errors.lastLines();
  return result;
}

ProcessResult runProcess(const std::vector<std::string>& words, double seconds, const std::atomic<bool>* isCancelled) {
  return ChildProcess(words, ChildProcess::Talk::None).finish(seconds, isCancelled);
}

bool startDetached(const std::vector<std::string>& words, std::chrono::milliseconds wait) {
  pid_t process = 0;
  if (start(words, {}, POSIX_SPAWN_SETSID, process) != 0) return false;
  for (const auto begin = Clock::now(); Clock::now() - begin < wait; std::this_thread::sleep_for(checkInterval)) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) == process) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return true;
}

}  // namespace hemitex::reference
