/// The program hemitex-vector: the commands for test vectors that need no scene, for authors of backends.
#include "cli/common/commands.h"
#include "cli/common/program.h"

namespace {

using namespace hemitex::cli;

void addCommands(Command program, Context& context) {
  addVectorCommands(program, context);
  program.addExamples({"run suite --device './draw {vector} {output}' -o drawn", "check suite --candidate drawn"});
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram({"hemitex-vector",
                     "hemitex-vector checks a rasterizer backend: it compares item IDs with the raster rules, pixel by "
                     "pixel, and explains the differences.",
                     "give --jobs or --threads a smaller number", addCommands},
                    argc, argv);
}
