#include "raster/base/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::raster {
namespace {

/// Removes only regular files, which this program began to write, never a folder or a device of that name.
void removeBroken(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
}

std::string whyUnreadable(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (std::filesystem::is_other(status)) return "is a pipe or a device, not a file";
  if (std::filesystem::is_directory(status)) return "cannot be read: it is a folder";
  return std::filesystem::exists(status) ? "cannot be read" : "cannot be read: it does not exist";
}

}  // namespace

InputFile tryOpenFile(const std::filesystem::path& file) {
  // Without O_NONBLOCK, the call would wait for a program that writes into a pipe.
  const int descriptor = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return nullptr;
  struct stat status {};
  InputFile opened;
  if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) opened.reset(fdopen(descriptor, "rb"));
  if (!opened) close(descriptor);
  return opened;
}

InputFile openFile(const std::filesystem::path& file, const std::string& advice) {
  if (InputFile opened = tryOpenFile(file)) return opened;
  throw InputError(file.string(), 0, whyUnreadable(file), advice);
}

std::optional<std::string> tryReadFile(const std::filesystem::path& file) {
  const InputFile opened = tryOpenFile(file);
  struct stat status {};
  if (!opened || fstat(fileno(opened.get()), &status) != 0) return {};
  requireMemory(static_cast<std::uint64_t>(status.st_size), file.string(), "the file");
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size));
  std::vector<char> block(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), opened.get()))
    bytes.append(block.data(), count);
  if (std::ferror(opened.get())) return {};
  return bytes;
}

std::string readFile(const std::filesystem::path& file, const std::string& advice) {
  std::optional<std::string> bytes = tryReadFile(file);
  if (!bytes) throw InputError(file.string(), 0, whyUnreadable(file), advice);
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
