/// The command that starts a device's program for one vector, and how the program may fail.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reference/base/child_process.h"
#include "reference/conformance/vectors/enum_names.h"

namespace hemitex::reference {

/// Splits a command at blanks. Blanks inside '...' and "..." do not split; there is no other quoting. Throws InputError
/// for an empty command and for a quote without an end.
std::vector<std::string> splitCommand(const std::string& command);

/// The words with `vector` in place of {vector} and `output` in place of {output}.
std::vector<std::string> fillCommand(const std::vector<std::string>& words, const std::string& vector,
                                     const std::string& output);

/// Why a device has no item buffers for a vector.
enum class DeviceFault : std::uint8_t { Crash, ExitCode, TimeLimit, MissingFile, WrongSize, Refused };

/// In the order of the enum.
constexpr std::array<Named<DeviceFault>, 6> deviceFaultNames{{{DeviceFault::Crash, "crash"},
                                                              {DeviceFault::ExitCode, "exit code"},
                                                              {DeviceFault::TimeLimit, "time limit"},
                                                              {DeviceFault::MissingFile, "missing file"},
                                                              {DeviceFault::WrongSize, "wrong size"},
                                                              {DeviceFault::Refused, "refused"}}};

struct DeviceFailure {
  DeviceFault fault;
  std::string message;  ///< "ended by signal 11 (Segmentation fault)"
  ProcessResult process;
};

/// Requires a process that was stopped or ended by a signal or with an exit code other than 0.
DeviceFailure failureOf(const ProcessResult& process);

}  // namespace hemitex::reference
