/// Names on a command line: what may follow, which the completion scripts of shells (shell_files.h) ask the program
/// for, and what may be meant by a wrong one.
#pragma once

#include <string>
#include <vector>

#include "cli/help/command_tree.h"

namespace hemitex::cli {

/// The only completion where the path of a file is expected, and where that of a scene is.
inline const std::string fileCompletion = "<files>", sceneCompletion = "<scenes>";

/// Offers for the last of `words`, which follow the name of the program; it may be incomplete or empty. One line each,
/// a text or a text, a tab and its help: the values of the option before it, the options of the command if it begins
/// with a dash, or the commands.
std::string completionsFor(const CommandInfo& program, const std::vector<std::string>& words);

/// Says that the program does not know `unknown`, the first such argument of `arguments`, and which options or commands
/// have similar names.
std::string unknownArgument(const CommandInfo& program, const std::vector<std::string>& arguments,
                            const std::string& unknown);

}  // namespace hemitex::cli
