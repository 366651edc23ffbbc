/// Whole files, read and written.
#pragma once

#include <filesystem>
#include <string>

namespace hemitex::reference {

/// The bytes of a file. Throws InputError, with its name, where they cannot be read: there is no file, it is a folder,
/// the disk fails.
std::string readText(const std::filesystem::path& file);

/// Writes or replaces a file. Throws InputError, with its name, where that fails.
void writeText(const std::filesystem::path& file, const std::string& text);

}  // namespace hemitex::reference
