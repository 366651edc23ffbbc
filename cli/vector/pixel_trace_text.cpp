#include "cli/vector/pixel_trace_text.h"

#include <array>
#include <map>

#include "cli/common/numbers.h"
#include "reference/conformance/vectors/enum_names.h"

namespace hemitex::cli {
namespace {

using Json = nlohmann::ordered_json;
using raster::HalfSpace;
using reference::Derivation;
using reference::EdgeKind;

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

// --- text ---

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

}  // namespace

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

Json toJson(const raster::Face& face) {
  return {{"eye", list(face.eye)}, {"x", list(face.x)},         {"y", list(face.y)},
          {"w", list(face.w)},     {"near", face.nearDistance}, {"resolution", face.resolution}};
}

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

}  // namespace hemitex::cli
