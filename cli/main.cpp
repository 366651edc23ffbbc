/// The program hemitex.
#include "cli/common/commands.h"
#include "cli/common/program.h"
#include "radiosity/ranks/messenger.h"

namespace {

using namespace hemitex::cli;

void addCommands(Command program, Context& context) {
  addSolve(program, context);
  addRender(program, context);
  addView(program, context);
  addWatch(program, context);
  addFormFactors(program, context);
  addMatrix(program, context);
  addTradeoff(program, context);
  addPaper(program, context);
  addBench(program, context);
  const Command vector = program.addCommand("vector", "Test vectors for rasterizer backends");
  addVectorExport(vector, context);
  addVectorSuite(vector, context);
  addVectorCommands(vector, context);
  vector.addExamples({"suite -o suite", "check suite --candidate drawn"});
  program.addExamples({"solve data/cornell-box.obj -o lit", "render lit/scene.obj -o picture.png --size 1200x900"});
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram(
      {"hemitex",
       "hemitex computes the light of an OBJ or glTF scene by radiosity and writes the scene with its light in "
       "textures.",
       "use fewer texels (--texels) or a smaller --row-cache", addCommands, hemitex::radiosity::startMpi},
      argc, argv);
}
