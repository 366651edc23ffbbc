/// Runs the program of a device for one vector. The program is someone else's: it may crash, hang or write anything.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "reference/conformance/vectors/enum_names.h"

namespace hemitex::reference {

/// Splits a command at blanks. Blanks inside '...' and "..." do not split; there is no other quoting. Throws InputError
/// for an empty command and for a quote without an end.
std::vector<std::string> splitCommand(const std::string& command);

/// The words with `vector` in place of {vector} and `output` in place of {output}.
std::vector<std::string> fillCommand(const std::vector<std::string>& words, const std::string& vector,
                                     const std::string& output);

struct ProcessResult {
  int exitCode = 0;
  int signal = 0;  ///< that ended the process; 0 if it exited
  bool isTimedOut = false;
  std::vector<std::string> lastLines = {};  ///< of stderr, at most 10
};

/// Starts the program words[0] with the other words as arguments, without a shell, and waits for its end. The program
/// reads nothing from stdin, and what it writes to stdout is ignored. After `seconds` its process group gets SIGTERM,
/// and one second later SIGKILL. Its process group also ends when the program ends, and when `isCancelled` becomes
/// true. Several threads may call it at a time. Throws InputError if the program cannot be started.
ProcessResult runProcess(const std::vector<std::string>& words, double seconds,
                         const std::atomic<bool>* isCancelled = nullptr);

/// Why a device has no item buffers for a vector.
enum class DeviceFault : std::uint8_t { Crash, ExitCode, TimeLimit, MissingFile, WrongSize };

/// In the order of the enum.
constexpr std::array<Named<DeviceFault>, 5> deviceFaultNames{{{DeviceFault::Crash, "crash"},
                                                              {DeviceFault::ExitCode, "exit code"},
                                                              {DeviceFault::TimeLimit, "time limit"},
                                                              {DeviceFault::MissingFile, "missing file"},
                                                              {DeviceFault::WrongSize, "wrong size"}}};

struct DeviceFailure {
  DeviceFault fault;
  std::string message;  ///< "ended by signal 11 (Segmentation fault)"
  ProcessResult process;
};

/// Requires a process that was stopped or ended by a signal or with an exit code other than 0.
DeviceFailure failureOf(const ProcessResult& process);
bool hasSucceeded(const ProcessResult& process);

}  // namespace hemitex::reference
