/// The commands of the program, one file each: what the command line holds, what is called, what is printed.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/common/options.h"

namespace hemitex::cli {

/// Each adds its command to the program. `context` outlives the program's line.
void addSolve(CLI::App& program, Context& context);
void addRender(CLI::App& program, Context& context);
void addFormFactors(CLI::App& program, Context& context);
void addTradeoff(CLI::App& program, Context& context);
void addPaper(CLI::App& program, Context& context);
void addBench(CLI::App& program, Context& context);
void addVector(CLI::App& program, Context& context);
/// Commands of `vector`.
void addVectorSuite(CLI::App& vector, Context& context);
void addVectorCheck(CLI::App& vector, Context& context);
void addVectorExplain(CLI::App& vector, Context& context);
void addVectorCalibrate(CLI::App& vector, Context& context);

}  // namespace hemitex::cli
