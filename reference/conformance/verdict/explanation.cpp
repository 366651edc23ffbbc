#include "reference/conformance/verdict/explanation.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/plain/plain_renderer.h"
#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/trace/pixel_trace.h"
#include "reference/conformance/vectors/enum_names.h"
#include "reference/conformance/verdict/error_pixel.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::ClipPlane;

Json list(const glm::vec2& v) { return {v.x, v.y}; }
Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }
Json list(const glm::dvec2& v) { return {v.x, v.y}; }
Json list(const glm::ivec2& v) { return {v.x, v.y}; }

constexpr std::array<Named<ClipPlane>, 8> clipPlaneNames{{{ClipPlane::Near, "near"},
                                                          {ClipPlane::ZeroZ, "z = 0"},
                                                          {ClipPlane::LeastZ, "z = -w"},
                                                          {ClipPlane::LargestZ, "z = w"},
                                                          {ClipPlane::Right, "right"},
                                                          {ClipPlane::Left, "left"},
                                                          {ClipPlane::Upper, "top"},
                                                          {ClipPlane::Lower, "bottom"}}};
constexpr std::array<Named<EdgeKind>, 3> edgeKindNames{
    {{EdgeKind::Top, "top"}, {EdgeKind::Left, "left"}, {EdgeKind::Other, "other"}}};

Json cornersOf(const Derivation& derivation) {
  Json corners;
  for (const DerivedCorner& corner : derivation.corners) {
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
  for (const DerivedVertex& vertex : derivation.vertices)
    vertices.push_back({{"index", vertex.index},
                        {"position", list(vertex.position)},
                        {"from_eye", list(vertex.fromEye)},
                        {"view", list(vertex.view)},
                        {"texcoord", list(vertex.texcoord)}});
  return vertices;
}

Json toJson(const Derivation& derivation) {
  const Fragment& visible = derivation.visible;
  Json cutBy = Json::array();
  for (const ClipPlane plane : derivation.cutBy) cutBy.push_back(nameOf(clipPlaneNames, plane));
  Json edges;
  for (const DerivedEdge& edge : derivation.edges)
    edges.push_back({{"value", edge.value}, {"kind", nameOf(edgeKindNames, edge.kind)}});
  Json sums = Json::array();
  for (const DerivedSum& sum : derivation.sums)
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
  Json steps{{"triangle", visible.triangle},
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
  if (derivation.depth) steps["depth"] = *derivation.depth;
  if (derivation.runnerUp && derivation.runnerUp->depth) steps["runner_up"]["depth"] = *derivation.runnerUp->depth;
  return steps;
}

/// The triangles that cover the pixel, nearest first.
Json trianglesOf(const std::vector<Fragment>& fragments) {
  Json triangles = Json::array();
  for (const Fragment& fragment : fragments) {
    const auto texel = [&](int Texel::*side) { return fragment.texel ? Json(*fragment.texel.*side) : Json(""); };
    triangles.push_back({{"triangle", fragment.triangle},
                         {"draw", fragment.draw},
                         {"facing", fragment.facesAway ? "back" : "front"},
                         {"w", 1 / fragment.inverseDepth},
                         {"u", fragment.u},
                         {"v", fragment.v},
                         {"column", texel(&Texel::column)},
                         {"row", texel(&Texel::row)},
                         {"word", fragment.id}});
  }
  return triangles;
}

void requireInside(const raster::Scissor& scissor, int column, int row) {
  if (column >= scissor.column && column < scissor.column + scissor.width && row >= scissor.row &&
      row < scissor.row + scissor.height)
    return;
  throw raster::InputError("the face has no pixel " + std::to_string(column) + "," + std::to_string(row),
                           "its first column is " + std::to_string(scissor.column) + ", its first row " +
                               std::to_string(scissor.row) + ", and its size " + std::to_string(scissor.width) + " x " +
                               std::to_string(scissor.height));
}

}  // namespace

Json viewOf(const raster::Face& face) {
  Json view{{"eye", list(face.eye)}, {"x", list(face.x)},         {"y", list(face.y)},
            {"w", list(face.w)},     {"near", face.nearDistance}, {"resolution", face.resolution}};
  if (face.viewport) view["resolution"] = {face.viewport->columns, face.viewport->rows};
  return view;
}

Json explanation(const TestVector& vector, const VectorFace& face, int column, int row) {
  requireInside(face.face.scissor, column, row);
  const auto triangles = raster::snappedTriangles(vector.list, face.face);
  const auto fragments = fragmentsAt(vector.list, triangles, column, row);
  const auto derivation = derive(vector.list, face.face, fragments, column, row);
  const raster::ItemId id = derivation ? derivation->visible.id : raster::clearedValue(vector.list);
  const auto draw = derivation ? std::optional(derivation->visible.draw) : std::nullopt;
  return {{"face", face.name},
          {"column", column},
          {"row", row},
          {"word", id},
          {"from", toText(originOf(vector.list, id, draw))},
          {"derivation", derivation ? toJson(*derivation) : Json()},
          {"triangles", trianglesOf(fragments)}};
}

}  // namespace hemitex::reference
