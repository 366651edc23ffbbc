/// `hemitex vector suite` writes every test vector of the suite with its item IDs, one folder each, and prints the
/// faults that each of them detects.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/program.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::cli {
namespace {

namespace filesystem = std::filesystem;

void writeSuite(const filesystem::path& output, const Context& context) {
  const std::vector<reference::TestVector> suite = reference::wholeSuite(sceneFolder());
  std::vector<std::string> hashes;
  for (const reference::TestVector& vector : suite) {
    const std::vector<raster::ItemBuffer> buffers = reference::render(vector);
    Staging staging(output / vector.name);
    reference::writeVector(staging.folder(), vector, buffers);
    staging.commit();
    hashes.push_back(reference::idsHash(buffers));
  }
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    return {suite[index].name, suite[index].catches, hashes[index]};
  };
  const Table table{{"name", "catches", "hash"}, suite.size(), row};
  if (context.json)
    std::cout << toText({{"vectors", toJson(table)}});
  else
    writeCsv(std::cout, table);
}

}  // namespace

void addVectorSuite(Command vector, Context& context) {
  const auto output = std::make_shared<filesystem::path>();
  const Command command = vector.addCommand("suite", "Write every test vector of the suite, one folder each");
  addOutput(command, *output, "write the vectors into this folder");
  command.addExamples({"-o suite", "-o suite --json"});
  command.onRead([output, &context] { context.command = [output, &context] { writeSuite(*output, context); }; });
}

}  // namespace hemitex::cli
