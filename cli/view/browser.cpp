#include "cli/view/browser.h"

#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "reference/conformance/verdict/spawn_settings.h"

extern char** environ;

namespace hemitex::cli {
namespace {

std::vector<std::string> splitAt(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// The words of a command, with the path of the file.
std::vector<std::string> wordsOf(const std::string& command, const std::string& path) {
  std::vector<std::string> words = splitAt(command, ' ');
  bool isNamed = false;
  for (std::string& word : words)
    if (const std::size_t place = word.find("%s"); place != std::string::npos) {
      word.replace(place, 2, path);
      isNamed = true;
    }
  if (!isNamed) words.push_back(path);
  return words;
}

/// Starts a program. Nothing if it cannot be started.
std::optional<pid_t> start(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const reference::SpawnSettings settings(-1, POSIX_SPAWN_SETSID);
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, arguments.front(), &settings.actions, &settings.attributes, arguments.data(), environ);
  return error == 0 ? std::optional(process) : std::nullopt;
}

/// Whether a process still runs after two seconds, or ended with exit code 0.
bool isGood(pid_t process) {
  constexpr int steps = 100;
  for (int step = 0; step < steps; ++step) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) == process) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace

std::vector<std::string> browserCommands() {
  if (isSet("BROWSER")) return splitAt(std::getenv("BROWSER"), ':');
#ifdef __APPLE__
  return {"open"};
#else
  if (isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")) return {"xdg-open"};
  return {};
#endif
}

std::optional<std::string> openInBrowser(const std::vector<std::string>& commands, const std::filesystem::path& file) {
  for (const std::string& command : commands)
    if (const std::optional<pid_t> process = start(wordsOf(command, std::filesystem::absolute(file).string())))
      if (isGood(*process)) return command;
  return std::nullopt;
}

}  // namespace hemitex::cli
