/// The program of a device as `vector run` starts it, and what it writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/vectors/vector_file.h"
#include "reference/verdict/device_process.h"

namespace hemitex::cli {

struct DeviceProgram {
  std::vector<std::string> command;  ///< with {vector} and {output}
  double timeLimit = 10;             ///< seconds per vector
};

/// During its lifetime SIGINT and SIGTERM stop the programs of the device before this one ends.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether a signal arrived. Then programs of the device no longer start.
  static bool hasHappened();
  /// Ends this program by the signal that arrived.
  static void passOn();
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
/// function makes. Returns why there are none.
std::optional<reference::DeviceFailure> draw(const DeviceProgram& program, const reference::TestVector& vector,
                                             const std::filesystem::path& folder, const std::filesystem::path& output);

}  // namespace hemitex::cli
