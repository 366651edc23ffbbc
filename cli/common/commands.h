/// Declares the commands of the programs. Each has its own file, with its options, calls and output.
#pragma once

#include "cli/common/options.h"

namespace hemitex::cli {

/// Each function adds one command to the program. `context` must outlive the program.
void addSolve(Command program, Context& context);
void addRender(Command program, Context& context);
void addView(Command program, Context& context);
void addWatch(Command program, Context& context);
void addFormFactors(Command program, Context& context);
void addMatrix(Command program, Context& context);
void addTradeoff(Command program, Context& context);
void addPaper(Command program, Context& context);
void addBench(Command program, Context& context);

/// Commands for test vectors that need scenes.
void addVectorExport(Command vector, Context& context);
void addVectorSuite(Command vector, Context& context);
/// Commands for test vectors that need no scene.
void addVectorRender(Command vector, Context& context);
void addVectorRandom(Command vector, Context& context);
void addVectorCheck(Command vector, Context& context);
void addVectorRun(Command vector, Context& context);
void addVectorServe(Command vector, Context& context);
void addVectorExplain(Command vector, Context& context);
void addVectorCalibrate(Command vector, Context& context);
void addVectorVerify(Command vector, Context& context);

/// All commands that need no scene: hemitex-vector has them alone, `hemitex vector` beside `export` and `suite`.
inline void addVectorCommands(Command parent, Context& context) {
  for (const auto add : {addVectorRender, addVectorRandom, addVectorCheck, addVectorRun, addVectorServe,
                         addVectorExplain, addVectorCalibrate, addVectorVerify})
    add(parent, context);
}

}  // namespace hemitex::cli
