/// `hemitex vector random` writes random test vectors with their item IDs, one folder each. A seed gives the same
/// vectors on every machine.
#include <iostream>
#include <limits>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "reference/conformance/vectors/random_families.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::cli {
namespace {

struct RandomOptions {
  int seed = 0;
  int count = 0;
  std::string family;  ///< empty: all of them in turn
  std::filesystem::path output;
};

reference::TestVector vectorOf(const RandomOptions& options, int index) {
  const auto seed = static_cast<std::uint64_t>(options.seed), number = static_cast<std::uint64_t>(index);
  return options.family.empty() ? reference::interleavedRandomVector(seed, number)
                                : reference::randomVector(seed + number, options.family);
}

void writeRandom(const RandomOptions& options, const Context& context) {
  std::vector<std::vector<Cell>> rows;
  for (int index = 0; index < options.count; ++index) {
    const reference::TestVector vector = vectorOf(options, index);
    const std::vector<raster::ItemBuffer> buffers = reference::render(vector);
    Staging staging(options.output / vector.name);
    reference::writeVector(staging.folder(), vector, buffers);
    staging.commit();
    rows.push_back({vector.name, vector.catches, reference::idsHash(buffers)});
  }
  const Table table{{"name", "catches", "hash"}, rows.size(), [&](std::size_t index) { return rows[index]; }};
  if (context.json)
    std::cout << toText({{"vectors", toJson(table)}});
  else
    writeCsv(std::cout, table);
}

std::string familyNames() {
  std::string names;
  for (const reference::RandomFamily& family : reference::randomFamilies())
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
  command.addText("--family", "NAME", "family with ascending seeds (default: all in turn): " + familyNames(),
                  [options](const std::string& name) { options->family = name; });
  addOutput(command, options->output, "folder for the vectors");
  command.addExamples({"--seed 1 --count 10 -o random", "--seed 7 --count 1 --family slivers -o random"});
  command.onRead([options, &context] { context.command = [options, &context] { writeRandom(*options, context); }; });
}

}  // namespace hemitex::cli
