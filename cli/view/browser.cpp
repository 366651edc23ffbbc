#include "cli/view/browser.h"

#include <boost/algorithm/string.hpp>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

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

/// The commands that open a file, in the order in which to try them: those of `$BROWSER` (a list separated by `:`),
/// else `xdg-open` or `open`. Empty if there is neither `$BROWSER` nor a display, so that no window can appear.
std::vector<std::string> browserCommands() {
  if (isSet("BROWSER")) return splitAt(std::getenv("BROWSER"), ":");
#ifdef __APPLE__
  return {"open"};
#else
  if (isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")) return {"xdg-open"};
  return {};
#endif
}

}  // namespace

bool openInBrowser(const std::filesystem::path& file, Console& console) {
  const std::vector<std::string> commands = browserCommands();
  const std::string path = std::filesystem::absolute(file).string();
  // The path replaces `%s` or is appended.
  for (const std::string& command : commands)
    if (reference::startDetached(wordsOf(command, path), std::chrono::seconds(2))) return true;
  console.message(commands.empty()
                      ? "there is no display and no $BROWSER; open the page yourself"
                      : "no browser could be started (" + boost::join(commands, ", ") + "); open the page yourself");
  return false;
}

}  // namespace hemitex::cli
