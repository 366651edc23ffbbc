/// Quotes text for a POSIX shell, so that a person can copy a suggested command line.
#pragma once

#include <string>

namespace hemitex::cli {

/// The text in single quotes; a shell reads it as one word. For sh, bash and zsh.
std::string shellQuoted(const std::string& text);

}  // namespace hemitex::cli
