/// The commands for test vectors that need no scene. `hemitex vector` has them beside `export` and `suite`;
/// hemitex-vector has them alone.
#include "cli/common/commands.h"

namespace hemitex::cli {

void addVectorCommands(Command parent, Context& context) {
  addVectorRender(parent, context);
  addVectorRandom(parent, context);
  addVectorCheck(parent, context);
  addVectorRun(parent, context);
  addVectorExplain(parent, context);
  addVectorCalibrate(parent, context);
  addVectorVerify(parent, context);
}

}  // namespace hemitex::cli
