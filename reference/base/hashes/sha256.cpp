#include "reference/base/hashes/sha256.h"

#include <sha2.h>
#include <sys/types.h>

#include <fstream>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::reference {

std::string sha256(std::string_view bytes) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits);
  return digits;
}

std::string sha256OfFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  SHA2_CTX context;
  SHA256Init(&context);
  std::vector<char> block(std::size_t{1} << 16);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0)
    SHA256Update(&context, reinterpret_cast<const std::uint8_t*>(block.data()),
                 static_cast<std::size_t>(stream.gcount()));
  if (!stream.eof()) throw raster::InputError(file.string(), 0, "cannot be read");
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256End(&context, digits);
  return digits;
}

}  // namespace hemitex::reference
