/// `hemitex vector suite` writes every test vector of the suite with its item IDs, one folder each, and prints the
/// faults that each of them detects.
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/program.h"
#include "cli/vector/vector_output.h"
#include "reference/conformance/scenes/scene_vectors.h"

namespace hemitex::cli {
namespace {

void writeSuite(const std::filesystem::path& output, const Context& context) {
  const std::vector<reference::TestVector> suite = reference::wholeSuite(sceneFolder());
  writeVectors(
      output, "vector suite", suite.size(), [&suite](std::size_t k) { return suite[k]; }, true, context);
}

}  // namespace

void addVectorSuite(Command vector, Context& context) {
  const auto output = std::make_shared<std::filesystem::path>();
  const Command command = vector.addCommand("suite", "Write every test vector of the suite, one folder each");
  addOutput(command, *output, "write the vectors into this folder");
  command.addExamples({"-o suite", "-o suite --json"});
  command.onRead([output, &context] { context.command = [output, &context] { writeSuite(*output, context); }; });
}

}  // namespace hemitex::cli
