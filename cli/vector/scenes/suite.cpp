/// `hemitex vector suite` writes every test vector of the suite with its item IDs, one folder each, and prints the
/// faults that each of them detects. The rules of version 2 have a suite of their own.
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/program.h"
#include "cli/vector/vector_output.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"

namespace hemitex::cli {
namespace {

struct SuiteOptions {
  std::filesystem::path output;
  int rules = 1;
};

void writeSuite(const SuiteOptions& options, const Context& context) {
  const std::vector<reference::TestVector> suite =
      options.rules == 2 ? reference::drawVectors() : reference::wholeSuite(sceneFolder());
  writeVectors(
      options.output, "vector suite", suite.size(), [&suite](std::size_t k) { return suite[k]; }, true, context);
}

}  // namespace

void addVectorSuite(Command vector, Context& context) {
  const auto options = std::make_shared<SuiteOptions>();
  const Command command = vector.addCommand("suite", "Write every test vector of the suite, one folder each");
  addInteger(command, "--rules", options->rules, 1, 2, "version of the rules; the suite of version 2 is another one");
  addOutput(command, options->output, "write the vectors into this folder");
  command.addExamples({"-o suite", "--rules 2 -o suite-2"});
  command.onRead([options, &context] { context.command = [options, &context] { writeSuite(*options, context); }; });
}

}  // namespace hemitex::cli
