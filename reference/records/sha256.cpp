#include "reference/records/sha256.h"

#include <sha2.h>
#include <sys/types.h>

namespace hemitex::reference {

std::string sha256(std::string_view bytes) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits);
  return digits;
}

}  // namespace hemitex::reference
