#include "cli/vector/pixel_trace_text.h"

#include <sstream>

#include "cli/common/numbers.h"

namespace hemitex::cli {
namespace {

using Json = nlohmann::ordered_json;
using raster::HalfSpace;
using reference::Derivation;
using reference::EdgeKind;

// --- numbers ---

std::string text(double value) { return toText(value); }
std::string text(float value) { return toText(value); }
std::string text(int value) { return std::to_string(value); }

/// "(1, 2, 3)".
template <typename... Numbers>
std::string tuple(const Numbers&... numbers) {
  std::string joined;
  for (const std::string& number : {text(numbers)...}) joined += (joined.empty() ? "(" : ", ") + number;
  return joined + ")";
}

std::string tuple(const glm::vec2& v) { return tuple(v.x, v.y); }
std::string tuple(const glm::vec3& v) { return tuple(v.x, v.y, v.z); }
std::string tuple(const glm::dvec2& v) { return tuple(v.x, v.y); }
std::string tuple(const glm::ivec2& v) { return tuple(v.x, v.y); }

std::string nameOf(const reference::DrawnTriangle& drawn) {
  return "triangle " + std::to_string(drawn.triangle) + " of draw " + std::to_string(drawn.draw);
}

// --- the steps as text ---

void writeVertices(std::ostream& out, const Derivation& derivation, const raster::Face& face) {
  out << "vertices of " << nameOf(derivation.drawn) << ": d = P - E, then x = X.d, y = Y.d, w = W.d in binary32\n"
      << "  E " << tuple(face.eye) << ", X " << tuple(face.x) << ", Y " << tuple(face.y) << ", W " << tuple(face.w)
      << '\n';
  for (const reference::DerivedVertex& vertex : derivation.vertices)
    out << "  vertex " << vertex.index << ": P " << tuple(vertex.position) << ", d " << tuple(vertex.fromEye)
        << ", (x, y, w) = " << tuple(vertex.view) << ", (u, v) = " << tuple(vertex.texcoord) << '\n';
}

const char* conditionOf(HalfSpace halfSpace) {
  switch (halfSpace) {
    case HalfSpace::Near:
      return "w >= n";
    case HalfSpace::Right:
      return "x <= 8w";
    case HalfSpace::Left:
      return "-x <= 8w";
    case HalfSpace::Top:
      return "y <= 8w";
    case HalfSpace::Bottom:
      return "-y <= 8w";
  }
  return "";
}

void writeClip(std::ostream& out, const Derivation& derivation, const raster::Face& face) {
  out << "clip to w >= n = " << text(face.nearDistance) << " and |x|, |y| <= 8w: ";
  if (derivation.cutBy.empty()) {
    out << "nothing is cut\n";
  } else {
    out << "cut by ";
    for (std::size_t k = 0; k < derivation.cutBy.size(); ++k)
      out << (k > 0 ? ", " : "") << conditionOf(derivation.cutBy[k]);
    out << "; triangle " << derivation.piece + 1 << " of the " << derivation.pieces << " that are left\n";
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const raster::ViewVertex& view = derivation.corners[k].view;
    out << "  corner " << k << ": (x, y, w) = " << tuple(view.x, view.y, view.w)
        << ", (u, v) = " << tuple(view.u, view.v) << '\n';
  }
}

void writeSnap(std::ostream& out, const Derivation& derivation, const raster::Face& face) {
  out << "snap: q = (x/w, y/w), held to [-8, 8]; s = nearbyint((q + 1) 128 R) with R = " << face.resolution << '\n';
  for (std::size_t k = 0; k < 3; ++k)
    out << "  corner " << k << ": q = " << tuple(derivation.corners[k].q)
        << ", s = " << tuple(derivation.corners[k].snapped) << '\n';
}

std::string judged(const reference::DerivedEdge& edge) {
  if (edge.value > 0) return "inside";
  return edge.kind == EdgeKind::Top ? "on a top edge, which is covered" : "on a left edge, which is covered";
}

void writeCover(std::ostream& out, const Derivation& derivation, const raster::Face& face) {
  out << "cover: sample " << tuple(derivation.sample) << ", doubled area A = " << derivation.area
      << " and det(X, Y, W) " << (raster::determinant(face) > 0 ? "> 0" : "< 0") << ": it faces "
      << (derivation.facesAway ? "away" : "the eye") << '\n';
  for (std::size_t k = 0; k < 3; ++k)
    out << "  edge from corner " << (k + 1) % 3 << " to " << (k + 2) % 3 << ": e" << k << " = "
        << derivation.edges[k].value << ", " << judged(derivation.edges[k]) << '\n';
}

void writeInterpolation(std::ostream& out, const Derivation& derivation) {
  const std::array<double, 3>& b = derivation.weights;
  out << "interpolate: b = e / |A| = " << tuple(b[0], b[1], b[2]) << '\n'
      << "  1/w = sum of b/w = " << text(derivation.inverseDepth) << '\n'
      << "  (u, v) = sum of b (u, v)/w over 1/w = " << tuple(derivation.coordinates) << '\n';
}

void writeRunnerUp(std::ostream& out, const Derivation& derivation) {
  out << "depth: ";
  if (!derivation.runnerUp) {
    out << "no other triangle covers the sample\n";
    return;
  }
  const reference::RunnerUp& other = *derivation.runnerUp;
  out << nameOf(other.drawn) << " comes next with 1/w = " << text(other.inverseDepth) << ", ";
  if (other.difference == 0)
    out << "exactly as near: the one drawn first stays\n";
  else
    out << "which is less by " << text(other.difference) << '\n';
}

void writeTexel(std::ostream& out, const reference::DerivedTexel& texel) {
  out << "texel: (u N, v M) = " << tuple(texel.position) << " with N x M = " << texel.width << " x " << texel.height
      << "; floor, held to the map: " << tuple(texel.texel.column, texel.texel.row) << " holds " << texel.index << '\n';
}

void writeSums(std::ostream& out, const Derivation& derivation, raster::Blend blend) {
  const bool isClamped = blend == raster::Blend::ClampedAdd;
  for (std::size_t k = 0; k < derivation.sums.size(); ++k) {
    const reference::DerivedSum& sum = derivation.sums[k];
    out << "  ";
    if (isClamped) out << "channel " << k << ", ";
    out << sum.bits << " bits: " << sum.offset << " + " << sum.texel;
    if (sum.offset + sum.texel != sum.result)
      out << " = " << sum.offset + sum.texel << (isClamped ? ", clamped to " : ", modulo 2^m ") << sum.result << '\n';
    else
      out << " = " << sum.result << '\n';
  }
}

void writeBlend(std::ostream& out, const Derivation& derivation, const raster::DrawList& list) {
  const raster::Draw& draw = list.draws[derivation.drawn.draw];
  if (!derivation.texel) {
    const bool isBack = derivation.facesAway && draw.back;
    out << (isBack ? "blend: none, the draw gives its back item ID\n" : "blend: none, the draw has no index map\n");
  } else if (list.blend == raster::Blend::Replace) {
    out << "blend: replace, the texel alone\n";
  } else {
    out << (list.blend == raster::Blend::ClampedAdd ? "blend: clamped add" : "blend: integer add") << " of offset "
        << draw.offset << " and texel " << derivation.texel->index << '\n';
    writeSums(out, derivation, list.blend);
  }
  out << "  item ID " << derivation.id << '\n';
}

// --- the same as JSON ---

Json list(const glm::vec2& v) { return {v.x, v.y}; }
Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }
Json list(const glm::dvec2& v) { return {v.x, v.y}; }
Json list(const glm::ivec2& v) { return {v.x, v.y}; }

const char* nameOf(HalfSpace halfSpace) {
  switch (halfSpace) {
    case HalfSpace::Near:
      return "near";
    case HalfSpace::Right:
      return "right";
    case HalfSpace::Left:
      return "left";
    case HalfSpace::Top:
      return "top";
    case HalfSpace::Bottom:
      return "bottom";
  }
  return "";
}

const char* nameOf(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::Top:
      return "top";
    case EdgeKind::Left:
      return "left";
    case EdgeKind::Other:
      return "other";
  }
  return "";
}

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

}  // namespace

std::string toText(const Derivation& derivation, const raster::DrawList& list, const raster::Face& face) {
  std::ostringstream out;
  writeVertices(out, derivation, face);
  writeClip(out, derivation, face);
  writeSnap(out, derivation, face);
  writeCover(out, derivation, face);
  writeInterpolation(out, derivation);
  writeRunnerUp(out, derivation);
  if (derivation.texel) writeTexel(out, *derivation.texel);
  writeBlend(out, derivation, list);
  return out.str();
}

Json toJson(const Derivation& derivation) {
  Json cutBy = Json::array();
  for (const HalfSpace halfSpace : derivation.cutBy) cutBy.push_back(nameOf(halfSpace));
  Json edges;
  for (const reference::DerivedEdge& edge : derivation.edges)
    edges.push_back({{"value", edge.value}, {"kind", nameOf(edge.kind)}});
  Json sums = Json::array();
  for (const reference::DerivedSum& sum : derivation.sums)
    sums.push_back({{"bits", sum.bits}, {"offset", sum.offset}, {"texel", sum.texel}, {"result", sum.result}});
  Json texel;
  if (const auto& found = derivation.texel)
    texel = {{"width", found->width},         {"height", found->height}, {"position", list(found->position)},
             {"column", found->texel.column}, {"row", found->texel.row}, {"index", found->index}};
  Json runnerUp;
  if (const auto& other = derivation.runnerUp)
    runnerUp = {{"triangle", other->drawn.triangle},
                {"draw", other->drawn.draw},
                {"inverse_depth", other->inverseDepth},
                {"difference", other->difference}};
  return {{"triangle", derivation.drawn.triangle},
          {"draw", derivation.drawn.draw},
          {"vertices", verticesOf(derivation)},
          {"clip", {{"cut_by", cutBy}, {"piece", derivation.piece}, {"pieces", derivation.pieces}}},
          {"corners", cornersOf(derivation)},
          {"sample", list(derivation.sample)},
          {"area", derivation.area},
          {"faces_away", derivation.facesAway},
          {"edges", edges},
          {"weights", derivation.weights},
          {"inverse_depth", derivation.inverseDepth},
          {"u", derivation.coordinates.x},
          {"v", derivation.coordinates.y},
          {"texel", texel},
          {"sums", sums},
          {"word", derivation.id},
          {"runner_up", runnerUp}};
}

}  // namespace hemitex::cli
