/// The program of a device as `vector run` starts it, and what it writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_process.h"

namespace hemitex::cli {

struct DeviceProgram {
  std::vector<std::string> command;  ///< with {vector} and {output}
  double timeLimit = 10;             ///< seconds per vector
};

/// A new empty folder for files that nobody keeps.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path path;
};

/// Starts the program for the vector in `folder`. It writes its item ID files into `output`, an empty folder that this
/// function makes. Returns why there are none. A LongRun that stops ends the program.
std::optional<reference::DeviceFailure> draw(const DeviceProgram& program, const reference::TestVector& vector,
                                             const std::filesystem::path& folder, const std::filesystem::path& output);

}  // namespace hemitex::cli
