/// Writing a whole file or none.
#pragma once

#include <filesystem>
#include <string_view>

namespace hemitex::radiosity {

/// Writes `bytes` as `file`, over what was there. Throws InputError where that fails, and leaves no file with a part
/// of the bytes.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hemitex::radiosity
