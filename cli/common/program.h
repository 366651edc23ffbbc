/// The common part of the programs: reads the command line, runs a command and reports errors. Results go to stdout,
/// messages to stderr.
#pragma once

#include <functional>
#include <string>

#include "cli/common/options.h"

namespace hemitex::cli {

struct Program {
  std::string name;
  std::string purpose;       ///< a sentence, for the help text
  std::string memoryAdvice;  ///< what to do when memory runs out
  std::function<void(Command, Context&)> addCommands;
};

/// Writes what stdout still holds. Throws InputError if that fails; `state` continues its message and may say which
/// files are complete.
void requireOutput(const std::string& state = {});

/// Returns the exit code: 0 done; 1 a comparison failed; 2 the input or the usage is wrong; 3 internal error.
int runProgram(const Program& program, int argc, char** argv);

}  // namespace hemitex::cli
