/// Opens pages in the browser of the user.
#pragma once

#include <filesystem>

#include "cli/common/console.h"

namespace hemitex::cli {

/// Starts a command of `$BROWSER` (a list separated by `:`), else `xdg-open` or `open`, with the path of the file.
/// Waits at most two seconds for it to end. Returns whether a command runs or ended with exit code 0; if none does, a
/// message says so.
bool openInBrowser(const std::filesystem::path& file, Console& console);

}  // namespace hemitex::cli
