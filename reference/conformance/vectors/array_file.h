/// Array files of test vectors: binary little-endian numbers without a header. Both functions throw InputError with the
/// name of the file.
#pragma once

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::reference {

// Arrays are read and written as they are in memory.
static_assert(std::endian::native == std::endian::little);

/// All numbers of a file.
template <typename T>
std::vector<T> readArray(const std::filesystem::path& file) {
  const std::string bytes = raster::readFile(file);
  if (bytes.size() % sizeof(T) != 0)
    throw raster::InputError(
        file.string(), 0,
        std::to_string(bytes.size()) + " bytes are not whole entries of " + std::to_string(sizeof(T)) + " bytes");
  std::vector<T> values(bytes.size() / sizeof(T));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
  return values;
}

/// Writes or replaces a file of numbers.
template <typename T>
void writeArray(const std::filesystem::path& file, const std::vector<T>& values) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  stream.close();
  if (!stream) throw raster::InputError(file.string(), 0, "cannot be written");
}

}  // namespace hemitex::reference
