/// What may follow on a command line. The completion scripts of shells (shell_files.h) ask the program for it.
#pragma once

#include <string>
#include <vector>

#include "cli/help/command_tree.h"

namespace hemitex::cli {

/// The only completion where the path of a file is expected.
inline const std::string fileCompletion = "<files>";

/// Offers for the last of `words`, which follow the name of the program; it may be incomplete or empty. One line each,
/// a text or a text, a tab and its help: the values of the option before it, the options of the command if it begins
/// with a dash, or the commands.
std::string completionsFor(const CommandInfo& program, const std::vector<std::string>& words);

}  // namespace hemitex::cli
