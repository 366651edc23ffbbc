/// Whole files, read and written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace hemitex::raster {

/// The bytes of a file; nothing where they cannot be read: there is no file, it is a folder, the disk fails.
std::optional<std::string> tryReadFile(const std::filesystem::path& file);

/// The same. Throws InputError, with the file's name and `advice`, where they cannot be read.
std::string readFile(const std::filesystem::path& file, const std::string& advice = {});

/// Writes `bytes` as `file`, over what was there. Throws InputError where that fails, and leaves no file with a part
/// of the bytes.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hemitex::raster
