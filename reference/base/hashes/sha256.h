/// SHA-256 (FIPS 180-4, 2015), by libmd.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hemitex::reference {

/// The number of digits of a hash.
inline constexpr std::size_t sha256Digits = 64;

/// As sha256Digits hexadecimal digits.
std::string sha256(std::string_view bytes);

/// The same of the content of a file, which need not fit into memory. Throws InputError if it cannot be read.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace hemitex::reference
