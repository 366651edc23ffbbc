/// Reads and writes whole files.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace hemitex::raster {

/// Returns the bytes of a regular file, or nothing if they cannot be read: no such file, an I/O error, a folder, or a
/// pipe or device, which might never end.
std::optional<std::string> tryReadFile(const std::filesystem::path& file);

/// As tryReadFile, but throws InputError with the file's name and `advice` if the file cannot be read.
std::string readFile(const std::filesystem::path& file, const std::string& advice = {});

/// Writes `bytes` to `file` and replaces its content. Throws InputError on failure, and then leaves no partly written
/// file.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

/// As above for content that need not be in memory: `write` writes it to a stream.
void writeFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace hemitex::raster
