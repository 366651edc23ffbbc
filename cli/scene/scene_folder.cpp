#include "cli/scene/scene_folder.h"

#include "raster/base/input_error.h"

namespace hemitex::cli {

std::filesystem::path sceneFolder() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path folder = program.parent_path().parent_path() / "share" / "hemitex";
  if (!std::filesystem::is_directory(folder))
    throw raster::InputError(folder.string(), 0, "does not exist, but should hold the scenes of the program",
                             "run the program from the folder into which `cmake --install` puts it");
  return folder;
}

}  // namespace hemitex::cli
