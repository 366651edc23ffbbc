#include "cli/vector/vector_output.h"

#include <iostream>

#include "cli/common/json.h"
#include "cli/common/table.h"

namespace hemitex::cli {
namespace {

/// The faces of a vector, as a table.
Table tableOf(const reference::TestVector& vector) {
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    const reference::VectorFace& face = vector.faces[index];
    return {face.name, std::int64_t{face.face.scissor.width}, std::int64_t{face.face.scissor.height}, face.hash};
  };
  return {{"face", "width", "height", "hash"}, vector.faces.size(), row};
}

}  // namespace

void printFaces(const reference::TestVector& vector, const Context& context) {
  if (context.json)
    std::cout << toText({{"name", vector.name}, {"faces", toJson(tableOf(vector))}});
  else
    writeCsv(std::cout, tableOf(vector));
}

void addStages(Command command, bool& stages) {
  command.addFlag("--stages", stages,
                  "also write the intermediate results between vertices and item IDs (stages.json)");
}

}  // namespace hemitex::cli
