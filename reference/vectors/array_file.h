/// Files of nothing but numbers, binary and little-endian, as test vectors are made of. Both functions throw InputError
/// with the file's name.
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

// So are all machines that this code is built for.
static_assert(std::endian::native == std::endian::little);

/// The numbers of a whole file.
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
