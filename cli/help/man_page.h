/// Manual pages in the man macros of roff.
#pragma once

#include <string>

#include "cli/help/command_tree.h"

namespace hemitex::cli {

/// The name of the page of a command, such as `hemitex-vector-check`.
std::string manPageName(const CommandInfo& command);

/// The page of a command. It has no date, so that builds are reproducible.
std::string manPage(const CommandInfo& command, const std::string& version);

}  // namespace hemitex::cli
