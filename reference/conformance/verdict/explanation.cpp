#include "reference/conformance/verdict/explanation.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/plain/plain_renderer.h"
#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/vectors/colour_channels.h"
#include "reference/conformance/vectors/enum_names.h"
#include "reference/conformance/verdict/error_pixel.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using Rational = boost::multiprecision::cpp_rational;
using raster::ClipPlane, raster::EdgeKind, raster::SnappedTriangle, raster::ViewVertex;

Json list(const glm::vec2& v) { return {v.x, v.y}; }
Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

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

// --- the triangle ---

Json verticesOf(const raster::DrawList& drawn, const raster::Face& face, std::uint32_t triangle,
                const std::array<ViewVertex, 3>& views) {
  Json vertices;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = drawn.indices[3 * std::size_t{triangle} + k];
    const glm::vec3 position = drawn.positions[index];
    vertices.push_back({{"index", index},
                        {"position", list(position)},
                        {"from_eye", list(position - face.eye)},
                        {"view", list(glm::vec3(views[k].x, views[k].y, views[k].w))},
                        {"texcoord", list(drawn.texcoords[index])}});
  }
  return vertices;
}

Json clipOf(const raster::DrawList& drawn, const raster::Face& face, const SnappedTriangle& screen,
            const std::array<ViewVertex, 3>& views) {
  Json cutBy = Json::array();
  for (const ClipPlane plane : raster::clipPlanes(drawn.clipDepth))
    if (raster::cuts(plane, views, face.nearDistance)) cutBy.push_back(nameOf(clipPlaneNames, plane));
  const auto pieces = static_cast<int>(raster::clip(views, face.nearDistance, drawn.clipDepth).count) - 2;
  return {{"cut_by", cutBy}, {"piece", screen.piece}, {"pieces", pieces}};
}

Json cornersOf(const SnappedTriangle& screen) {
  Json corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const ViewVertex& view = screen.vertices[k];
    corners.push_back({{"view", {view.x, view.y, view.w}},
                       {"texcoord", {view.u, view.v}},
                       {"q", {view.x / view.w, view.y / view.w}},
                       {"snapped", {screen.corners[k].x, screen.corners[k].y}}});
  }
  return corners;
}

// --- the fragment at the sample ---

/// A fragment with exact sums, which are rounded once to binary64.
class ExactFragment {
 public:
  ExactFragment(const Fragment& fragment, const raster::SnappedPoint& sample)
      : screen_(fragment.screen),
        weights_(weightsAt(screen_, sample)),
        overDepth_(raster::weightsOverDepth<Rational>(screen_, weights_)) {}

  const raster::Weights& weights() const { return weights_; }
  Rational inverseDepth() const { return raster::inverseDepth(overDepth_); }
  Rational interpolated(double ViewVertex::*coordinate) const {
    return raster::interpolated(screen_, overDepth_, coordinate);
  }
  /// The stored depth, or z/w in clip space; null where 1/w is the depth.
  Json ownDepth(const raster::DrawList& drawn) const {
    if (drawn.clipDepth == raster::ClipDepth::None && drawn.depthPrecision == raster::DepthPrecision::Exact) return {};
    return coveredSample(screen_, weights_).depth;
  }

 private:
  const SnappedTriangle& screen_;
  raster::Weights weights_;
  std::array<Rational, 3> overDepth_;
};

double rounded(const Rational& number) { return number.convert_to<double>(); }

/// Clamped add has a sum per channel, integer add one, and replace none.
Json sumsOf(const raster::DrawList& drawn, raster::ItemId offset, raster::ItemId texel, raster::ItemId id) {
  Json sums = Json::array();
  if (drawn.blend == raster::Blend::Replace) return sums;
  const bool isClamped = drawn.blend == raster::Blend::ClampedAdd;
  for (const Channel& channel :
       isClamped ? channelsOf(drawn.format) : std::vector{Channel{0, raster::idBits(drawn.format)}})
    sums.push_back({{"bits", channel.bits},
                    {"offset", channel.of(offset)},
                    {"texel", channel.of(texel)},
                    {"result", channel.of(id)}});
  return sums;
}

/// The first fragment behind the visible one that is of another triangle; null without one.
Json runnerUpOf(const raster::DrawList& drawn, const std::vector<Fragment>& fragments, const Rational& inverseDepth,
                const raster::SnappedPoint& sample) {
  const Fragment& front = fragments.front();
  const auto other = std::find_if(fragments.begin(), fragments.end(), [&](const Fragment& fragment) {
    return fragment.triangle != front.triangle || fragment.draw != front.draw;
  });
  if (other == fragments.end()) return {};
  const ExactFragment exact(*other, sample);
  const Rational behind = exact.inverseDepth();
  Json runnerUp{{"triangle", other->triangle},
                {"draw", other->draw},
                {"inverse_depth", rounded(behind)},
                {"difference", rounded(inverseDepth - behind)}};
  if (const Json depth = exact.ownDepth(drawn); !depth.is_null()) runnerUp["depth"] = depth;
  return runnerUp;
}

/// Every number from the vertices to the blend; null for the background.
Json derivationOf(const raster::DrawList& drawn, const raster::Face& face, const std::vector<Fragment>& fragments,
                  int column, int row) {
  if (fragments.empty()) return {};
  const Fragment& visible = fragments.front();
  const SnappedTriangle& screen = visible.screen;
  const std::array<ViewVertex, 3> views = raster::view(face, drawn, screen.number);
  const raster::SnappedPoint sample = raster::sampleOf(column, row);
  const ExactFragment exact(visible, sample);
  const Rational u = exact.interpolated(&ViewVertex::u), v = exact.interpolated(&ViewVertex::v);
  Json edges, weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t value = exact.weights()[k];
    edges.push_back({{"value", value}, {"kind", nameOf(edgeKindNames, kindOf(directionOf(screen, k)))}});
    weights.push_back(static_cast<double>(value) / static_cast<double>(std::abs(screen.area)));
  }
  Json texel, sums = Json::array();
  if (visible.texel) {
    const raster::Draw& draw = drawn.draws[visible.draw];
    const raster::IndexMap& map = raster::mapOf(drawn, draw);
    const raster::ItemId index = raster::indexAt(drawn, draw, *visible.texel);
    texel = {{"width", map.width},
             {"height", map.height},
             {"position", {rounded(u * map.width), rounded(v * map.height)}},
             {"column", visible.texel->column},
             {"row", visible.texel->row},
             {"index", index}};
    sums = sumsOf(drawn, draw.offset, index, visible.id);
  }
  Json steps{{"triangle", visible.triangle},
             {"draw", visible.draw},
             {"vertices", verticesOf(drawn, face, screen.number, views)},
             {"clip", clipOf(drawn, face, screen, views)},
             {"corners", cornersOf(screen)},
             {"sample", {sample.x, sample.y}},
             {"area", screen.area},
             {"faces_away", visible.facesAway},
             {"edges", edges},
             {"weights", weights},
             {"inverse_depth", rounded(exact.inverseDepth())},
             {"u", rounded(u)},
             {"v", rounded(v)},
             {"texel", texel},
             {"sums", sums},
             {"word", visible.id},
             {"runner_up", runnerUpOf(drawn, fragments, exact.inverseDepth(), sample)}};
  if (const Json depth = exact.ownDepth(drawn); !depth.is_null()) steps["depth"] = depth;
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
  const bool isCovered = !fragments.empty();
  const raster::ItemId id = isCovered ? fragments.front().id : raster::clearedValue(vector.list);
  const auto draw = isCovered ? std::optional(fragments.front().draw) : std::nullopt;
  return {{"face", face.name},
          {"column", column},
          {"row", row},
          {"word", id},
          {"from", toText(originOf(vector.list, id, draw))},
          {"derivation", derivationOf(vector.list, face.face, fragments, column, row)},
          {"triangles", trianglesOf(fragments)}};
}

}  // namespace hemitex::reference
