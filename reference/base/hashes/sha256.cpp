#include "reference/base/hashes/sha256.h"

#include <sha2.h>
#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <vector>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::reference {

std::string sha256(std::string_view bytes) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits);
  return digits;
}

std::string sha256OfFile(const std::filesystem::path& file) {
  const raster::InputFile opened = raster::openFile(file);
  SHA2_CTX context;
  SHA256Init(&context);
  std::vector<std::uint8_t> block(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), opened.get()))
    SHA256Update(&context, block.data(), count);
  if (std::ferror(opened.get())) throw raster::InputError(file.string(), 0, "cannot be read");
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256End(&context, digits);
  return digits;
}

}  // namespace hemitex::reference
