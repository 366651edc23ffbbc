#include "raster/base/text_file.h"

#include <fstream>
#include <iterator>

#include "raster/base/input_error.h"

namespace hemitex::reference {

std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw raster::InputError(file.string(), 0, "cannot be read");
  try {
    return {std::istreambuf_iterator<char>(stream), {}};
  } catch (const std::ios_base::failure& error) {  // that of a folder, too
    throw raster::InputError(file.string(), 0, "cannot be read to its end");
  }
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw raster::InputError(file.string(), 0, "cannot be written");
}

}  // namespace hemitex::reference
