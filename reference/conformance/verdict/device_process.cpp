#include "reference/conformance/verdict/device_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>
#include <system_error>

#include "raster/base/input_error.h"
#include "reference/conformance/verdict/spawn_settings.h"

extern char** environ;

namespace hemitex::reference {
namespace {

using raster::InputError;
using Clock = std::chrono::steady_clock;

constexpr std::size_t maxLines = 10;
constexpr std::size_t maxBytes = 4096;
constexpr std::chrono::milliseconds checkInterval{5};
constexpr std::chrono::seconds timeToTerminate{1};

std::string messageOf(int error) { return std::generic_category().message(error); }

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

pid_t start(const std::vector<std::string>& words, int errorStream) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const SpawnSettings settings(errorStream, POSIX_SPAWN_SETPGROUP);
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, arguments[0], &settings.actions, &settings.attributes, arguments.data(), environ);
  if (error != 0)
    throw InputError("the program \"" + words[0] + "\" cannot be started: " + messageOf(error),
                     "correct the command of the device");
  return process;
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

std::size_t findQuoteEnd(const std::string& command, std::size_t quote) {
  const std::size_t end = command.find(command[quote], quote + 1);
  if (end == std::string::npos)
    throw InputError("the command " + command + " has a quote without an end", "close it or remove it");
  return end;
}

}  // namespace

std::vector<std::string> splitCommand(const std::string& command) {
  std::vector<std::string> words;
  bool isInWord = false;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const char c = command[k];
    const bool isBlank = c == ' ' || c == '\t' || c == '\n';
    if (!isBlank && !isInWord) words.emplace_back();
    isInWord = !isBlank;
    if (c == '\'' || c == '"') {
      const std::size_t end = findQuoteEnd(command, k);
      words.back() += command.substr(k + 1, end - k - 1);
      k = end;
    } else if (!isBlank) {
      words.back() += c;
    }
  }
  if (words.empty() || words[0].empty()) throw InputError("the command names no program");
  return words;
}

std::vector<std::string> fillCommand(const std::vector<std::string>& words, const std::string& vector,
                                     const std::string& output) {
  const std::string vectorMark = "{vector}", outputMark = "{output}";
  std::vector<std::string> filled;
  for (const std::string& word : words) {
    std::string& result = filled.emplace_back();
    for (std::size_t k = 0; k < word.size();) {
      const bool isVector = word.compare(k, vectorMark.size(), vectorMark) == 0;
      const bool isOutput = word.compare(k, outputMark.size(), outputMark) == 0;
      result += isVector ? vector : isOutput ? output : word.substr(k, 1);
      k += isVector ? vectorMark.size() : isOutput ? outputMark.size() : 1;
    }
  }
  return filled;
}

ProcessResult runProcess(const std::vector<std::string>& words, double seconds, const std::atomic<bool>* isCancelled) {
  StreamEnd stream;
  const pid_t process = start(words, stream.writeEnd());
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

bool hasSucceeded(const ProcessResult& process) {
  return process.exitCode == 0 && process.signal == 0 && !process.isTimedOut;
}

DeviceFailure failureOf(const ProcessResult& process) {
  if (process.isTimedOut) return {DeviceFault::TimeLimit, "stopped at the time limit", process};
  if (process.signal == 0)
    return {DeviceFault::ExitCode, "ended with exit code " + std::to_string(process.exitCode), process};
  return {DeviceFault::Crash,
          "ended by signal " + std::to_string(process.signal) + " (" + strsignal(process.signal) + ")", process};
}

}  // namespace hemitex::reference
