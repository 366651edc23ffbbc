/// Text written to a file.
#pragma once

#include <filesystem>
#include <string>

namespace hemitex::reference {

/// Writes or replaces a file. Throws InputError, with its name, where that fails.
void writeText(const std::filesystem::path& file, const std::string& text);

}  // namespace hemitex::reference
