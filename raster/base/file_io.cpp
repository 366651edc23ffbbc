#include "raster/base/file_io.h"

#include <fstream>
#include <system_error>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// Only what we began to write is removed: never a folder or a device that happens to have the name.
void removeBroken(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
}

}  // namespace

void writeFile(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream stream(file, std::ios::binary);
  if (!stream) throw raster::InputError(file.string(), 0, "cannot be opened for writing", "choose another folder");
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) return;
  removeBroken(file);
  throw raster::InputError(file.string(), 0, "cannot be written", "make room on the disk or choose another folder");
}

}  // namespace hemitex::radiosity
