/// Where the scenes are that come with the program.
#pragma once

#include <filesystem>

namespace hemitex::cli {

/// share/hemitex beside the folder of the program, built or installed. Throws InputError where it is not there.
std::filesystem::path sceneFolder();

}  // namespace hemitex::cli
