/// The program hemitex-vector: the commands for test vectors that need no scene, for authors of backends.
#include "cli/common/commands.h"
#include "cli/common/program.h"

int main(int argc, char** argv) {
  using namespace hemitex::cli;
  return runProgram({"hemitex-vector",
                     "hemitex-vector checks a rasterizer backend: it compares item IDs with the raster rules, pixel by "
                     "pixel, and explains the differences.",
                     "give --jobs or --threads a smaller number", addVectorCommands},
                    argc, argv);
}
