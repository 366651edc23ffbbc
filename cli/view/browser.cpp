#include "cli/view/browser.h"

#include <boost/algorithm/string.hpp>
#include <chrono>
#include <cstdlib>

#include "reference/base/child_process.h"

namespace hemitex::cli {
namespace {

std::vector<std::string> splitAt(const std::string& text, const char* separator) {
  std::vector<std::string> parts;
  boost::split(parts, text, boost::is_any_of(separator));
  std::erase(parts, "");
  return parts;
}

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// The words of a command, with the path of the file.
std::vector<std::string> wordsOf(const std::string& command, const std::string& path) {
  std::vector<std::string> words = splitAt(command, " ");
  if (command.find("%s") == std::string::npos) words.push_back(path);
  for (std::string& word : words) boost::replace_first(word, "%s", path);
  return words;
}

}  // namespace

std::vector<std::string> browserCommands() {
  if (isSet("BROWSER")) return splitAt(std::getenv("BROWSER"), ":");
#ifdef __APPLE__
  return {"open"};
#else
  if (isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")) return {"xdg-open"};
  return {};
#endif
}

std::optional<std::string> openInBrowser(const std::vector<std::string>& commands, const std::filesystem::path& file) {
  for (const std::string& command : commands)
    if (reference::startDetached(wordsOf(command, std::filesystem::absolute(file).string()), std::chrono::seconds(2)))
      return command;
  return std::nullopt;
}

}  // namespace hemitex::cli
