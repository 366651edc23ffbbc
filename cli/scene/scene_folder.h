/// The folder of the scenes that come with the program.
#pragma once

#include <filesystem>

namespace hemitex::cli {

/// share/hemitex beside the folder of the program, in the build tree and when installed. Throws InputError if it does
/// not exist.
std::filesystem::path sceneFolder();

}  // namespace hemitex::cli
