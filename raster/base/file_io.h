/// Reads and writes whole files.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace hemitex::raster {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using InputFile = std::unique_ptr<std::FILE, CloseFile>;

/// Opens a file for reading, as all readers do; null unless it is a regular file that may be read: a folder is none,
/// nor is a pipe or a device, which might never end. Never waits.
InputFile tryOpenFile(const std::filesystem::path& file);

/// As tryOpenFile, but throws InputError, which says why, with `advice`.
InputFile openFile(const std::filesystem::path& file, const std::string& advice = {});

/// Returns the bytes of a file, or nothing if it cannot be opened as above, or an I/O error occurs. Throws SizeError if
/// they do not fit into the free memory (see memory_budget.h).
std::optional<std::string> tryReadFile(const std::filesystem::path& file);

/// As tryReadFile, but throws InputError, which says why, with `advice`.
std::string readFile(const std::filesystem::path& file, const std::string& advice = {});

/// Writes `bytes` to `file` and replaces its content. Throws InputError on failure, and then leaves no partly written
/// file.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

/// As above for content that need not be in memory: `write` writes it to a stream.
void writeFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace hemitex::raster
