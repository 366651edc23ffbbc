/// SHA-256 (FIPS 180-4, 2015), by libmd.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hemitex::reference {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

/// The same of the content of a file, which need not fit into memory. Throws InputError if it cannot be read.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace hemitex::reference
