#include "cli/vector/device_program.h"

#include "cli/common/interruption.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::ChildProcess;
using reference::DeviceFailure;
using reference::DeviceFault;

bool isAnswer(const std::string& line) { return line == "done" || line.starts_with("failed"); }

/// The line that asks a program that stays for a vector.
std::string requestFor(const fs::path& folder, const fs::path& output) {
  for (const fs::path& path : {folder, output})
    if (path.string().find_first_of("\t\n") != std::string::npos)
      throw raster::InputError(path.string(), 0, "has a tab or a line end in its name",
                               "choose another folder, because a line names it to the program");
  return folder.string() + '\t' + output.string();
}

/// What is wrong with the item ID files of a program that ended well.
std::optional<DeviceFailure> checkFiles(const reference::TestVector& vector, const fs::path& folder,
                                        const reference::ProcessResult& process) {
  const bool arePairs = reference::sourceOf(vector).value == raster::PixelValue::Pairs;
  for (const reference::VectorFace& face : vector.faces) {
    const fs::path file = folder / face.ids;
    if (!fs::is_regular_file(fs::symlink_status(file)))
      return DeviceFailure{DeviceFault::MissingFile, face.ids + " is missing", process};
    const auto width = static_cast<std::size_t>(face.face.scissor.width),
               height = static_cast<std::size_t>(face.face.scissor.height);
    const std::size_t bytes = width * height * (arePairs ? sizeof(std::uint64_t) : sizeof(raster::ItemId));
    if (fs::file_size(file) != bytes)
      return DeviceFailure{
          DeviceFault::WrongSize,
          face.ids + " holds " + std::to_string(fs::file_size(file)) + " bytes instead of " + std::to_string(bytes),
          process};
  }
  return {};
}

}  // namespace

std::optional<DeviceFailure> DeviceProgram::draw(const reference::TestVector& vector, const fs::path& folder,
                                                 const fs::path& output) {
  fs::create_directories(output);
  if (settings_.stays) {
    std::optional<DeviceFailure> failure;
    processes_.with([&](Process& process) { failure = ask(process, vector, folder, output); });
    return failure;
  }
  const auto words = reference::fillCommand(settings_.command, folder.string(), output.string());
  const reference::ProcessResult process = reference::runProcess(words, settings_.timeLimit, &LongRun::isStopping());
  if (process.hasSucceeded()) return checkFiles(vector, output, process);
  return failureOf(process);
}

std::optional<DeviceFailure> DeviceProgram::ask(Process& process, const reference::TestVector& vector,
                                                const fs::path& folder, const fs::path& output) const {
  const std::string request = requestFor(folder, output);
  if (!process) process = std::make_unique<ChildProcess>(settings_.command, ChildProcess::Talk::Lines);
  const auto answer = process->ask(request, isAnswer, settings_.timeLimit, &LongRun::isStopping());
  if (!answer) {
    const reference::ProcessResult end = process->finish(0);
    process.reset();
    return failureOf(end);
  }
  const reference::ProcessResult running{.lastLines = process->lastLines()};
  if (*answer != "done") return DeviceFailure{DeviceFault::Refused, *answer, running};
  return checkFiles(vector, output, running);
}

}  // namespace hemitex::cli
