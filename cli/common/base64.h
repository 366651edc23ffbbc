/// Bytes in base64, for pictures inside of pages.
#pragma once

#include <filesystem>
#include <string>

namespace hemitex::cli {

std::string base64(const std::string& bytes);
/// The bytes of a file. Throws InputError if it cannot be read.
std::string base64OfFile(const std::filesystem::path& file);

}  // namespace hemitex::cli
