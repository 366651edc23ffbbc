#include "reference/conformance/trace/pixel_trace.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cassert>

#include "reference/conformance/vectors/colour_channels.h"

namespace hemitex::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using raster::ScreenTriangle;
using raster::ViewVertex;

// --- vertices and clipping ---

/// Stores the vertices of a triangle, and returns them widened.
std::array<ViewVertex, 3> deriveVertices(const raster::DrawList& list, const raster::Face& face, std::uint32_t triangle,
                                         Derivation& derivation) {
  std::array<ViewVertex, 3> views;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = list.indices[3 * std::size_t{triangle} + k];
    const glm::vec3 position = list.positions[index];
    const ViewVertex view = views[k] = raster::transform(face, position, list.texcoords[index]);
    derivation.vertices[k] = {index, position, position - face.eye, {view.x, view.y, view.w}, list.texcoords[index]};
  }
  return views;
}

std::vector<raster::HalfSpace> cutsOf(const std::array<ViewVertex, 3>& vertices, double nearDistance) {
  std::vector<raster::HalfSpace> cuts;
  for (const raster::HalfSpace halfSpace : raster::halfSpaces)
    if (std::any_of(vertices.begin(), vertices.end(),
                    [&](const ViewVertex& vertex) { return raster::distance(halfSpace, vertex, nearDistance) < 0; }))
      cuts.push_back(halfSpace);
  return cuts;
}

// --- the fragment of a triangle at a sample ---

using Weights = std::array<Rational, 3>;

Weights weightsAt(const ScreenTriangle& triangle, int column, int row) {
  Weights weights;
  for (std::size_t k = 0; k < 3; ++k)
    weights[k] = Rational(triangle.edges[k].at(column, row)) / Rational(triangle.area);
  return weights;
}

/// The sum of b_k value_k / w_k.
Rational sumOverDepth(const ScreenTriangle& triangle, const Weights& weights, const std::array<double, 3>& values) {
  Rational sum;
  for (std::size_t k = 0; k < 3; ++k) sum += weights[k] * Rational(values[k]) / Rational(triangle.w[k]);
  return sum;
}

Rational inverseDepthOf(const ScreenTriangle& triangle, const Weights& weights) {
  return sumOverDepth(triangle, weights, {1, 1, 1});
}

bool isSame(const ScreenTriangle& a, const ScreenTriangle& b) {
  const auto isSameEdge = [](const raster::Edge& x, const raster::Edge& y) {
    return x.a == y.a && x.b == y.b && x.c == y.c;
  };
  return std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), isSameEdge) && a.w == b.w;
}

DerivedCorner cornerOf(const ViewVertex& view, int resolution) {
  const glm::dvec2 q(view.x / view.w, view.y / view.w);
  return {view, q, {raster::snap(q.x, resolution), raster::snap(q.y, resolution)}};
}

/// Finds `screen` in the fan that clipping leaves of the triangle, and stores its index and corners.
void derivePiece(const raster::Face& face, const std::array<ViewVertex, 3>& vertices, const ScreenTriangle& screen,
                 Derivation& derivation) {
  const bool mirrored = raster::determinant(face) < 0;
  const raster::ClippedPolygon polygon = raster::clip(vertices, face.nearDistance);
  derivation.pieces = polygon.count - 2;
  for (derivation.piece = 0; derivation.piece < derivation.pieces; ++derivation.piece) {
    const auto k = static_cast<std::size_t>(derivation.piece) + 1;
    const std::array<ViewVertex, 3> corners{polygon.vertices[0], polygon.vertices[k], polygon.vertices[k + 1]};
    ScreenTriangle candidate;
    if (!raster::makeScreenTriangle(face, corners, mirrored, candidate) || !isSame(candidate, screen)) continue;
    for (std::size_t c = 0; c < 3; ++c) derivation.corners[c] = cornerOf(corners[c], face.resolution);
    return;
  }
  assert(false);
}

std::int64_t signedArea(const std::array<DerivedCorner, 3>& corners) {
  const glm::i64vec2 p(corners[1].snapped - corners[0].snapped), q(corners[2].snapped - corners[0].snapped);
  return p.x * q.y - p.y * q.x;
}

DerivedEdge edgeAt(const raster::Edge& edge, int column, int row) {
  const EdgeKind kind = !edge.inclusive ? EdgeKind::Other : edge.a > 0 ? EdgeKind::Left : EdgeKind::Top;
  return {edge.at(column, row), kind};
}

// --- texel and blend ---

std::vector<DerivedSum> sumsOf(const raster::DrawList& list, raster::ItemId offset, raster::ItemId texel) {
  std::vector<DerivedSum> sums;
  if (list.blend == raster::Blend::Replace) return sums;
  const bool isClamped = list.blend == raster::Blend::ClampedAdd;
  for (const Channel& channel :
       isClamped ? channelsOf(list.format) : std::vector{Channel{0, raster::idBits(list.format)}}) {
    const std::uint64_t largest = channel.largest();
    DerivedSum sum{channel.bits, channel.of(offset), channel.of(texel), 0};
    sum.result = isClamped ? std::min(sum.offset + sum.texel, largest) : (sum.offset + sum.texel) & largest;
    sums.push_back(sum);
  }
  return sums;
}

void deriveId(const raster::DrawList& list, const Rational& u, const Rational& v, Derivation& derivation) {
  const Fragment& visible = derivation.visible;
  if (!visible.texel) return;
  const raster::Draw& draw = list.draws[visible.draw];
  const raster::IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const raster::ItemId index =
      map.ids[static_cast<std::size_t>(visible.texel->row * map.width + visible.texel->column)];
  const Rational column = u * map.width, row = v * map.height;
  derivation.texel = {map.width, map.height, {column.convert_to<double>(), row.convert_to<double>()}, index};
  derivation.sums = sumsOf(list, draw.offset, index);
}

/// The first fragment behind the visible one that is of another triangle.
std::optional<RunnerUp> runnerUpOf(const std::vector<Fragment>& fragments, const Rational& inverseDepth, int column,
                                   int row) {
  const Fragment& front = fragments.front();
  const auto other = std::find_if(fragments.begin(), fragments.end(), [&](const Fragment& fragment) {
    return fragment.triangle != front.triangle || fragment.draw != front.draw;
  });
  if (other == fragments.end()) return {};
  const Rational behind = inverseDepthOf(other->screen, weightsAt(other->screen, column, row));
  const Rational difference = inverseDepth - behind;
  return RunnerUp{{other->draw, other->triangle}, behind.convert_to<double>(), difference.convert_to<double>()};
}

}  // namespace

std::optional<Derivation> derive(const raster::DrawList& list, const raster::Face& face,
                                 const std::vector<Fragment>& fragments, int column, int row) {
  if (fragments.empty()) return {};
  Derivation derivation;
  derivation.visible = fragments.front();
  const ScreenTriangle& screen = derivation.visible.screen;
  const std::array<ViewVertex, 3> views = deriveVertices(list, face, derivation.visible.triangle, derivation);
  derivation.cutBy = cutsOf(views, face.nearDistance);
  derivePiece(face, views, screen, derivation);

  derivation.sample = {256 * column + 128, 256 * row + 128};
  derivation.area = signedArea(derivation.corners);
  const Weights weights = weightsAt(screen, column, row);
  for (std::size_t k = 0; k < 3; ++k) {
    derivation.edges[k] = edgeAt(screen.edges[k], column, row);
    derivation.weights[k] = weights[k].convert_to<double>();
  }
  const Rational inverseDepth = inverseDepthOf(screen, weights);
  const Rational u = sumOverDepth(screen, weights, screen.u) / inverseDepth;
  const Rational v = sumOverDepth(screen, weights, screen.v) / inverseDepth;
  derivation.inverseDepth = inverseDepth.convert_to<double>();
  derivation.coordinates = {u.convert_to<double>(), v.convert_to<double>()};
  deriveId(list, u, v, derivation);
  derivation.runnerUp = runnerUpOf(fragments, inverseDepth, column, row);
  return derivation;
}

}  // namespace hemitex::reference
