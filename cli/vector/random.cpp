/// `hemitex vector random` writes random test vectors with their item IDs, one folder each. A seed gives the same
/// vectors on every machine.
#include <limits>
#include <memory>

#include "cli/common/commands.h"
#include "cli/vector/vector_output.h"
#include "reference/conformance/vectors/random_vectors.h"

namespace hemitex::cli {
namespace {

struct RandomOptions {
  int seed = 0;
  int count = 0;
  std::string family;  ///< empty: all of them in turn
  std::filesystem::path output;
};

void writeRandom(const RandomOptions& options, const Context& context) {
  const auto seed = static_cast<std::uint64_t>(options.seed);
  const auto vectorAt = [&](std::size_t k) {
    return options.family.empty() ? reference::interleavedRandomVector(seed, k)
                                  : reference::randomVector(seed + k, options.family);
  };
  writeVectors(options.output, "vector random", static_cast<std::size_t>(options.count), vectorAt, true, context);
}

std::string familyNames() {
  std::string names;
  for (const auto& families : {reference::randomFamilies(), reference::newRandomFamilies()})
    for (const reference::RandomFamily& family : families)
      names += (names.empty() ? "" : ", ") + std::string(family.name);
  return names;
}

}  // namespace

void addVectorRandom(Command vector, Context& context) {
  const auto options = std::make_shared<RandomOptions>();
  const Command command =
      vector.addCommand("random",
                        "Write random test vectors, one folder FAMILY-SEED each; a seed gives the same bytes "
                        "on every machine");
  addInteger(command, "--seed", options->seed, 0, std::numeric_limits<int>::max(), "first seed").required();
  addInteger(command, "--count", options->count, 1, 1000000, "number of vectors").required();
  command.addText("--family", "NAME",
                  "family with ascending seeds (default: all of version 1 in turn): " + familyNames(), options->family);
  addOutput(command, options->output, "folder for the vectors");
  command.addExamples({"--seed 1 --count 10 -o random", "--seed 7 --count 1 --family slivers -o random"});
  command.onRead([options, &context] { context.command = [options, &context] { writeRandom(*options, context); }; });
}

}  // namespace hemitex::cli
