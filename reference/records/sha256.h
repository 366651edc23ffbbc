/// SHA-256 (FIPS 180-4, 2015), by libmd.
#pragma once

#include <string>
#include <string_view>

namespace hemitex::reference {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace hemitex::reference
