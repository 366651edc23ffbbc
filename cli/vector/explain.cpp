/// `hemitex vector explain` derives the item ID of one pixel by the raster rules, and lists the triangles that cover
/// it.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/table.h"
#include "raster/base/input_error.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/derivation_text.h"
#include "reference/conformance/verdict/explanation.h"

namespace hemitex::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Pixel {
  std::string face;
  int column = 0, row = 0;
};

/// `FACE,COLUMN,ROW`; the name of a face may contain commas.
Pixel pixelOption(const std::string& text) {
  const std::size_t second = text.rfind(',');
  const std::size_t first =
      second == std::string::npos || second == 0 ? std::string::npos : text.rfind(',', second - 1);
  if (first != std::string::npos) {
    const std::optional<int> column = parseInteger(text.substr(first + 1, second - first - 1));
    const std::optional<int> row = parseInteger(text.substr(second + 1));
    if (column && row) return {text.substr(0, first), *column, *row};
  }
  usageError("--pixel", "`" + text + "` is not FACE,COLUMN,ROW");
}

const reference::VectorFace& faceOf(const reference::TestVector& vector, const Pixel& pixel) {
  std::string names;
  for (const reference::VectorFace& face : vector.faces) {
    if (face.name == pixel.face) return face;
    names += (names.empty() ? "" : ", ") + face.name;
  }
  throw raster::InputError("--pixel: the vector has no face \"" + pixel.face + "\"", "it has " + names);
}

void explain(const std::filesystem::path& folder, const Pixel& pixel, const Context& context) {
  const reference::TestVector vector = reference::readVector(folder);
  const reference::VectorFace& face = faceOf(vector, pixel);
  const Json found = reference::explanation(vector, face, pixel.column, pixel.row);
  if (context.json) {
    std::cout << toText(found);
    return;
  }
  std::cout << reference::derivationText(found, face.face);
  if (found["derivation"].is_null()) return;
  std::cout << "triangles that cover it, nearest first:\n";
  writeCsv(std::cout, tableOf(found["triangles"]));
}

}  // namespace

void addVectorExplain(Command vector, Context& context) {
  struct Options {
    std::filesystem::path folder;
    Pixel pixel;
  };
  const auto options = std::make_shared<Options>();
  const Command command =
      vector.addCommand("explain", "Derive the item ID of one pixel by the raster rules, step by step");
  command.addPath("DIR", options->folder, "folder of the vector").required();
  const auto read = [options](const std::string& text) { options->pixel = pixelOption(text); };
  command
      .addText("--pixel", "FACE,COLUMN,ROW", "pixel to explain: name of a face, and column and row in its viewport",
               read)
      .required();
  command.addExamples({"suite/fans-later-nearer --pixel top,3,4", "vector --pixel side-up,20,5 --json"});
  command.onRead([options, &context] {
    context.command = [options, &context] { explain(options->folder, options->pixel, context); };
  });
}

}  // namespace hemitex::cli
