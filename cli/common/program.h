/// The common part of the programs: reads the command line, runs a command and reports errors. Results go to stdout,
/// messages to stderr.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "cli/common/options.h"

namespace hemitex::cli {

struct Program {
  std::string name;
  std::string purpose;       ///< a sentence, for the help text
  std::string memoryAdvice;  ///< what to do when memory runs out
  std::function<void(Command, Context&)> addCommands;
  /// Connects the ranks of a parallel run; empty if no command shares its work.
  std::function<std::unique_ptr<radiosity::Messenger>()> joinRanks = {};
};

/// The version of hemitex, such as `0.1.0`.
std::string programVersion();

/// Writes what stdout still holds. Throws InputError if that fails; `state` continues its message and may say which
/// files are complete. If the reader of a pipe has closed it, the program ends without a message.
void requireOutput(const std::string& state = {});

/// The folder of the scenes that come with the program: share/hemitex beside the folder of the program, in the build
/// tree and when installed. Throws InputError if it does not exist.
std::filesystem::path sceneFolder();

/// Returns the exit code: 0 done; 1 a comparison failed; 2 the input or the usage is wrong; 3 internal error; 141 the
/// reader of stdout has closed its pipe.
/// In a parallel run, ranks other than 0 print nothing, and the first error ends all ranks with its exit code.
int runProgram(const Program& program, int argc, char** argv);

}  // namespace hemitex::cli
