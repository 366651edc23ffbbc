#include "reference/text_file.h"

#include <fstream>

#include "raster/input_error.h"

namespace hemitex::reference {

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw raster::InputError(file.string(), 0, "cannot be written");
}

}  // namespace hemitex::reference
