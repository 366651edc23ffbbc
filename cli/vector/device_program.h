/// The program of a device, which draws test vectors.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "raster/base/pool.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_process.h"

namespace hemitex::cli {

struct DeviceSettings {
  std::vector<std::string> command;  ///< with {vector} and {output} for a program that draws one vector
  double timeLimit = 10;             ///< seconds per vector
  bool stays = false;                ///< the program draws many vectors, one per line on its stdin (docs/backend.md)
};

class DeviceProgram {
 public:
  explicit DeviceProgram(DeviceSettings settings) : settings_(std::move(settings)) {}

  /// Lets the program draw the vector in `folder`. It writes its item ID files into `output`, an empty folder that this
  /// function makes. Returns why there are none. A LongRun that stops ends the program. Several threads may call it at
  /// a time; a program that stays then runs as many times. Throws InputError if the program cannot be started.
  std::optional<reference::DeviceFailure> draw(const reference::TestVector& vector, const std::filesystem::path& folder,
                                               const std::filesystem::path& output);

 private:
  using Process = std::unique_ptr<reference::ChildProcess>;

  std::optional<reference::DeviceFailure> ask(Process& process, const reference::TestVector& vector,
                                              const std::filesystem::path& folder,
                                              const std::filesystem::path& output) const;

  DeviceSettings settings_;
  raster::Pool<Process> processes_;  ///< that stay; null before the start and after a failure
};

}  // namespace hemitex::cli
