/// The files that a shell and `man` read, in the layout of a share folder.
#pragma once

#include <filesystem>
#include <string>

#include "cli/help/command_tree.h"

namespace hemitex::cli {

/// Writes into `folder`, for each shell, the completion script, and one manual page per command:
///
///     bash-completion/completions/hemitex    fish/vendor_completions.d/hemitex.fish
///     zsh/site-functions/_hemitex            man/man1/hemitex.1, man/man1/hemitex-COMMAND.1
///
/// The scripts (for bash 4, zsh 5 and fish 3) ask the program what may follow: `--complete WORDS...` prints
/// completionsFor. Throws InputError or std::filesystem::filesystem_error if a file cannot be written.
void writeShellFiles(const std::filesystem::path& folder, const CommandInfo& program, const std::string& version);

}  // namespace hemitex::cli
