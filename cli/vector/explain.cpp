/// `hemitex vector explain` derives the item ID of one pixel by the raster rules, and lists the triangles that cover
/// it.
#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/table.h"
#include "cli/vector/pixel_trace_text.h"
#include "raster/base/input_error.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/id_origin.h"

namespace hemitex::cli {
namespace {

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

void requireInside(const raster::Scissor& scissor, const Pixel& pixel) {
  if (pixel.column >= scissor.column && pixel.column < scissor.column + scissor.width && pixel.row >= scissor.row &&
      pixel.row < scissor.row + scissor.height)
    return;
  throw raster::InputError(
      "--pixel: the face has no pixel " + std::to_string(pixel.column) + "," + std::to_string(pixel.row),
      "its first column is " + std::to_string(scissor.column) + ", its first row " + std::to_string(scissor.row) +
          ", and its size " + std::to_string(scissor.width) + " x " + std::to_string(scissor.height));
}

/// The triangles that cover the pixel, nearest first.
Table tableOf(const std::vector<reference::Fragment>& fragments) {
  const auto row = [&fragments](std::size_t index) -> std::vector<Cell> {
    const reference::Fragment& fragment = fragments[index];
    const auto texel = [&](int reference::Texel::*side) {
      return fragment.texel ? Cell(std::int64_t{*fragment.texel.*side}) : Cell("");
    };
    return {std::int64_t{fragment.triangle},
            std::int64_t{fragment.draw},
            fragment.facesAway ? "back" : "front",
            1 / fragment.inverseDepth,
            fragment.u,
            fragment.v,
            texel(&reference::Texel::column),
            texel(&reference::Texel::row),
            std::int64_t{fragment.id}};
  };
  return {{"triangle", "draw", "facing", "w", "u", "v", "column", "row", "word"}, fragments.size(), row};
}

void explain(const std::filesystem::path& folder, const Pixel& pixel, const Context& context) {
  const reference::TestVector vector = reference::readVector(folder);
  const raster::Face& face = faceOf(vector, pixel).face;
  requireInside(face.scissor, pixel);
  const auto fragments = reference::fragmentsAt(vector.list, face, pixel.column, pixel.row);
  const auto derivation = reference::derive(vector.list, face, fragments, pixel.column, pixel.row);
  const raster::ItemId id = derivation ? derivation->visible.id : raster::backgroundId(vector.list.format);
  const auto draw = derivation ? std::optional(derivation->visible.draw) : std::nullopt;
  const std::string origin = toText(reference::originOf(vector.list, id, draw));
  if (context.json) {
    std::cout << toText({{"face", pixel.face},
                         {"column", pixel.column},
                         {"row", pixel.row},
                         {"word", id},
                         {"from", origin},
                         {"derivation", derivation ? toJson(*derivation) : nlohmann::ordered_json()},
                         {"triangles", toJson(tableOf(fragments))}});
    return;
  }
  std::cout << "pixel " << pixel.column << ',' << pixel.row << " of " << pixel.face << " holds " << id << ": " << origin
            << "\n";
  if (!derivation) return;
  std::cout << toLines({{"face", toJson(face)}}) << toLines(toJson(*derivation))
            << "triangles that cover it, nearest first:\n";
  writeCsv(std::cout, tableOf(fragments));
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
