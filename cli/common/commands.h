/// The commands of the program, one file each: what the command line holds, what is called, what is printed.
#pragma once

#include "cli/common/options.h"

namespace hemitex::cli {

/// Each adds its command to the program. `context` outlives the program's line.
void addSolve(Command program, Context& context);
void addRender(Command program, Context& context);
void addFormFactors(Command program, Context& context);
void addTradeoff(Command program, Context& context);
void addPaper(Command program, Context& context);
void addBench(Command program, Context& context);
void addVector(Command program, Context& context);
/// Commands of `vector`.
void addVectorSuite(Command vector, Context& context);
void addVectorCheck(Command vector, Context& context);
void addVectorRun(Command vector, Context& context);
void addVectorExplain(Command vector, Context& context);
void addVectorCalibrate(Command vector, Context& context);

}  // namespace hemitex::cli
