#include "cli/vector/device_program.h"

#include <cstdlib>

#include "cli/common/interruption.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::DeviceFailure;
using reference::DeviceFault;

fs::path makeScratchFolder() {
  std::string name = (fs::temp_directory_path() / "hemitex-XXXXXX").string();
  if (!mkdtemp(name.data())) throw raster::InputError(name, 0, "a temporary folder cannot be made");
  return name;
}

/// What is wrong with the item ID files of a program that ended well.
std::optional<DeviceFailure> checkFiles(const reference::TestVector& vector, const fs::path& folder,
                                        const reference::ProcessResult& process) {
  for (const reference::VectorFace& face : vector.faces) {
    const fs::path file = folder / face.ids;
    if (!fs::is_regular_file(file)) return DeviceFailure{DeviceFault::MissingFile, face.ids + " is missing", process};
    const auto width = static_cast<std::size_t>(face.face.scissor.width),
               height = static_cast<std::size_t>(face.face.scissor.height);
    const std::size_t bytes = width * height * sizeof(raster::ItemId);
    if (fs::file_size(file) != bytes)
      return DeviceFailure{
          DeviceFault::WrongSize,
          face.ids + " holds " + std::to_string(fs::file_size(file)) + " bytes instead of " + std::to_string(bytes),
          process};
  }
  return {};
}

}  // namespace

ScratchFolder::ScratchFolder() : path(makeScratchFolder()) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

std::optional<DeviceFailure> draw(const DeviceProgram& program, const reference::TestVector& vector,
                                  const fs::path& folder, const fs::path& output) {
  fs::create_directories(output);
  const auto words = reference::fillCommand(program.command, folder.string(), output.string());
  const reference::ProcessResult process = reference::runProcess(words, program.timeLimit, &LongRun::isStopping());
  if (process.hasSucceeded()) return checkFiles(vector, output, process);
  return failureOf(process);
}

}  // namespace hemitex::cli
