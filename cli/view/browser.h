/// Opens a file in the user's browser.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hemitex::cli {

/// The commands that open a file, in the order in which to try them: those of `$BROWSER` (a list separated by `:`),
/// else `xdg-open` or `open`. Empty if there is neither `$BROWSER` nor a display, so that no window can appear.
std::vector<std::string> browserCommands();

/// Starts one of the commands with the path of the file, which replaces `%s` or is appended. Waits at most two seconds
/// for it to end. Returns the command that runs or ended with exit code 0; nothing if none did.
std::optional<std::string> openInBrowser(const std::vector<std::string>& commands, const std::filesystem::path& file);

}  // namespace hemitex::cli
