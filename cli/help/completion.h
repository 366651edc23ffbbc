/// Completion scripts for shells. Each offers the commands, the options of the command, the named values of the option
/// before the cursor, and files where a path is expected.
#pragma once

#include <string>

#include "cli/help/command_tree.h"

namespace hemitex::cli {

/// Each function returns the script for one shell; it depends on nothing but the shell (bash 4, zsh 5, fish 3).
std::string bashCompletion(const CommandInfo& program);
std::string zshCompletion(const CommandInfo& program);
std::string fishCompletion(const CommandInfo& program);

}  // namespace hemitex::cli
