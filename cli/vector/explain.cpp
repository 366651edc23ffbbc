/// `hemitex vector explain` derives the item ID of one pixel by the raster rules, and lists the triangles that cover
/// it.
#include <iostream>
#include <map>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/table.h"
#include "raster/base/input_error.h"
#include "reference/conformance/vectors/vector_file.h"
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

/// Where the values of a key come from.
const std::map<std::string, std::string> formulas{
    {"vertices", "d = P - eye; x = X.d, y = Y.d, w = W.d in binary32"},
    {"clip", "to w >= n and |x|, |y| <= 8w"},
    {"corners", "q = (x/w, y/w), clamped to [-8, 8]; snapped = nearbyint((q + 1) 128 R)"},
    {"sample", "in 1/256 pixel"},
    {"area", "doubled"},
    {"faces_away", "area and det(X, Y, W) have the same sign"},
    {"edges", "opposite the corners; inside > 0, and = 0 on top and left edges"},
    {"weights", "b = edge / |area|"},
    {"inverse_depth", "sum of b/w"},
    {"u", "sum of b u/w over 1/w"},
    {"v", "sum of b v/w over 1/w"},
    {"texel", "floor of position = (u N, v M), clamped to the map"},
    {"sums", "offset + texel, clamped or modulo 2^bits"},
    {"word", "the item ID"},
    {"runner_up", "the next triangle; difference of 1/w"}};

std::string inLine(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) {
    // A binary32 is written as such: 0.1, not 0.10000000149011612.
    const auto wide = value.get<double>();
    const auto narrow = static_cast<float>(wide);
    return static_cast<double>(narrow) == wide ? toText(narrow) : toText(wide);
  }
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, entry] : value.items())
    text += (text.empty() ? "" : ", ") + (value.is_object() ? key + " " : "") + inLine(entry);
  return value.is_object() ? text : "(" + text + ")";
}

/// A line per key, with the formula of its values; lists of objects take a line per entry.
std::string toLines(const Json& steps) {
  std::string lines;
  for (const auto& [key, value] : steps.items()) {
    const auto formula = formulas.find(key);
    lines += key + (formula == formulas.end() ? "" : " (" + formula->second + ")") + ":";
    const bool isList = value.is_array() && !value.empty() && value[0].is_object();
    if (isList)
      for (const Json& entry : value) lines += "\n  " + inLine(entry);
    else
      lines += " " + inLine(value);
    lines += "\n";
  }
  return lines;
}

void explain(const std::filesystem::path& folder, const Pixel& pixel, const Context& context) {
  const reference::TestVector vector = reference::readVector(folder);
  const reference::VectorFace& face = faceOf(vector, pixel);
  const Json found = reference::explanation(vector, face, pixel.column, pixel.row);
  if (context.json) {
    std::cout << toText(found);
    return;
  }
  std::cout << "pixel " << pixel.column << ',' << pixel.row << " of " << pixel.face << " holds " << found["word"]
            << ": " << found["from"].get<std::string>() << "\n";
  if (found["derivation"].is_null()) return;
  std::cout << toLines({{"face", reference::viewOf(face.face)}}) << toLines(found["derivation"])
            << "triangles that cover it, nearest first:\n";
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
