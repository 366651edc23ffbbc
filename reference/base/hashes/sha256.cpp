#include "reference/base/hashes/sha256.h"

#include <sha2.h>
#include <sys/types.h>

#include "raster/base/input_error.h"

namespace hemitex::reference {

std::string sha256(std::string_view bytes) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits);
  return digits;
}

std::string sha256OfFile(const std::filesystem::path& file) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  if (!SHA256File(file.c_str(), digits)) throw raster::InputError(file.string(), 0, "cannot be read");
  return digits;
}

}  // namespace hemitex::reference
