/// `hemitex vector explain` derives the item ID of one pixel by the raster rules, and lists the triangles that cover
/// it.
#include <array>
#include <iostream>
#include <map>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/table.h"
#include "raster/base/input_error.h"
#include "reference/conformance/trace/pixel_trace.h"
#include "reference/conformance/vectors/enum_names.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/error_pixel.h"

namespace hemitex::cli {
namespace {

using Json = nlohmann::ordered_json;
using raster::HalfSpace;
using reference::Derivation;
using reference::EdgeKind;

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

Json list(const glm::vec2& v) { return {v.x, v.y}; }
Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }
Json list(const glm::dvec2& v) { return {v.x, v.y}; }
Json list(const glm::ivec2& v) { return {v.x, v.y}; }

constexpr std::array<reference::Named<HalfSpace>, 5> halfSpaceNames{{{HalfSpace::Near, "near"},
                                                                     {HalfSpace::Right, "right"},
                                                                     {HalfSpace::Left, "left"},
                                                                     {HalfSpace::Top, "top"},
                                                                     {HalfSpace::Bottom, "bottom"}}};
constexpr std::array<reference::Named<EdgeKind>, 3> edgeKindNames{
    {{EdgeKind::Top, "top"}, {EdgeKind::Left, "left"}, {EdgeKind::Other, "other"}}};

Json cornersOf(const Derivation& derivation) {
  Json corners;
  for (const reference::DerivedCorner& corner : derivation.corners) {
    const raster::ViewVertex& view = corner.view;
    corners.push_back({{"view", {view.x, view.y, view.w}},
                       {"texcoord", {view.u, view.v}},
                       {"q", list(corner.q)},
                       {"snapped", list(corner.snapped)}});
  }
  return corners;
}

Json verticesOf(const Derivation& derivation) {
  Json vertices;
  for (const reference::DerivedVertex& vertex : derivation.vertices)
    vertices.push_back({{"index", vertex.index},
                        {"position", list(vertex.position)},
                        {"from_eye", list(vertex.fromEye)},
                        {"view", list(vertex.view)},
                        {"texcoord", list(vertex.texcoord)}});
  return vertices;
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

/// An object with the keys
///
/// - `triangle`, `draw`, `vertices` (`index`, `position`, `from_eye`, `view`, `texcoord`),
/// - `clip` (`cut_by`, `piece`, `pieces`), `corners` (`view`, `texcoord`, `q`, `snapped`),
/// - `sample`, `area`, `faces_away`, `edges` (`value`, `kind`), `weights`, `inverse_depth`, `u`, `v`,
/// - `texel` (`width`, `height`, `position`, `column`, `row`, `index`; null where there is none),
/// - `sums` (`bits`, `offset`, `texel`, `result`), `word` (the item ID),
/// - `runner_up` (`triangle`, `draw`, `inverse_depth`, `difference`; null where there is none).
Json toJson(const Derivation& derivation) {
  const reference::Fragment& visible = derivation.visible;
  Json cutBy = Json::array();
  for (const HalfSpace halfSpace : derivation.cutBy) cutBy.push_back(nameOf(halfSpaceNames, halfSpace));
  Json edges;
  for (const reference::DerivedEdge& edge : derivation.edges)
    edges.push_back({{"value", edge.value}, {"kind", nameOf(edgeKindNames, edge.kind)}});
  Json sums = Json::array();
  for (const reference::DerivedSum& sum : derivation.sums)
    sums.push_back({{"bits", sum.bits}, {"offset", sum.offset}, {"texel", sum.texel}, {"result", sum.result}});
  Json texel;
  if (const auto& found = derivation.texel)
    texel = {{"width", found->width},           {"height", found->height},   {"position", list(found->position)},
             {"column", visible.texel->column}, {"row", visible.texel->row}, {"index", found->index}};
  Json runnerUp;
  if (const auto& other = derivation.runnerUp)
    runnerUp = {{"triangle", other->drawn.triangle},
                {"draw", other->drawn.draw},
                {"inverse_depth", other->inverseDepth},
                {"difference", other->difference}};
  return {{"triangle", visible.triangle},
          {"draw", visible.draw},
          {"vertices", verticesOf(derivation)},
          {"clip", {{"cut_by", cutBy}, {"piece", derivation.piece}, {"pieces", derivation.pieces}}},
          {"corners", cornersOf(derivation)},
          {"sample", list(derivation.sample)},
          {"area", derivation.area},
          {"faces_away", visible.facesAway},
          {"edges", edges},
          {"weights", derivation.weights},
          {"inverse_depth", derivation.inverseDepth},
          {"u", derivation.coordinates.x},
          {"v", derivation.coordinates.y},
          {"texel", texel},
          {"sums", sums},
          {"word", visible.id},
          {"runner_up", runnerUp}};
}

/// The view of a face.
Json toJson(const raster::Face& face) {
  return {{"eye", list(face.eye)}, {"x", list(face.x)},         {"y", list(face.y)},
          {"w", list(face.w)},     {"near", face.nearDistance}, {"resolution", face.resolution}};
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

/// The triangles that cover the pixel, nearest first.
Json trianglesOf(const std::vector<reference::Fragment>& fragments) {
  return listOf(fragments, [](const reference::Fragment& fragment) -> Json {
    const auto texel = [&](int reference::Texel::*side) {
      return fragment.texel ? Json(*fragment.texel.*side) : Json("");
    };
    return {{"triangle", fragment.triangle},
            {"draw", fragment.draw},
            {"facing", fragment.facesAway ? "back" : "front"},
            {"w", 1 / fragment.inverseDepth},
            {"u", fragment.u},
            {"v", fragment.v},
            {"column", texel(&reference::Texel::column)},
            {"row", texel(&reference::Texel::row)},
            {"word", fragment.id}};
  });
}

void explain(const std::filesystem::path& folder, const Pixel& pixel, const Context& context) {
  const reference::TestVector vector = reference::readVector(folder);
  const raster::Face& face = faceOf(vector, pixel).face;
  requireInside(face.scissor, pixel);
  const auto triangles = reference::screenTriangles(vector.list, face);
  const auto fragments = reference::fragmentsAt(vector.list, triangles, pixel.column, pixel.row);
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
                         {"derivation", derivation ? toJson(*derivation) : Json()},
                         {"triangles", trianglesOf(fragments)}});
    return;
  }
  std::cout << "pixel " << pixel.column << ',' << pixel.row << " of " << pixel.face << " holds " << id << ": " << origin
            << "\n";
  if (!derivation) return;
  std::cout << toLines({{"face", toJson(face)}}) << toLines(toJson(*derivation))
            << "triangles that cover it, nearest first:\n";
  writeCsv(std::cout, tableOf(trianglesOf(fragments)));
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
