#include "raster/base/file_io.h"

#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

/// Removes only regular files, which this program began to write, never a folder or a device of that name.
void removeBroken(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
}

}  // namespace

std::optional<std::string> tryReadFile(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0)
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return {};
  return text;
}

std::string readFile(const std::filesystem::path& file, const std::string& advice) {
  std::optional<std::string> bytes = tryReadFile(file);
  std::error_code ignored;
  if (!bytes && std::filesystem::is_other(file, ignored))
    throw InputError(file.string(), 0, "is a pipe or a device, not a file", advice);
  if (!bytes) throw InputError(file.string(), 0, "cannot be read", advice);
  return std::move(*bytes);
}

void writeFile(const std::filesystem::path& file, std::string_view bytes) {
  writeFile(file,
            [bytes](std::ostream& stream) { stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void writeFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::ofstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), 0, "cannot be opened for writing", "choose another folder");
  write(stream);
  stream.close();
  if (stream) return;
  removeBroken(file);
  throw InputError(file.string(), 0, "cannot be written", "make room on the disk or choose another folder");
}

}  // namespace hemitex::raster
