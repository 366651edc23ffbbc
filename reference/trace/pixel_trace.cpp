#include "reference/trace/pixel_trace.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cassert>
#include <cmath>

#include "raster/setup/triangle_setup.h"

namespace hemitex::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using raster::ViewVertex;

// --- rules 2 and 3: vertices and clipping ---

DerivedVertex vertexOf(const raster::DrawList& list, const raster::Face& face, std::uint32_t index) {
  const glm::vec3 position = list.positions[index];
  const glm::vec2 texcoord = list.texcoords[index];
  const ViewVertex view = raster::transform(face, position, texcoord);
  return {index, position, position - face.eye, {view.x, view.y, view.w}, texcoord};
}

std::array<DerivedVertex, 3> verticesOf(const raster::DrawList& list, const raster::Face& face,
                                        std::uint32_t triangle) {
  const auto vertex = [&](std::size_t k) { return vertexOf(list, face, list.indices[3 * std::size_t{triangle} + k]); };
  return {vertex(0), vertex(1), vertex(2)};
}

std::array<ViewVertex, 3> widened(const std::array<DerivedVertex, 3>& vertices) {
  std::array<ViewVertex, 3> views;
  for (std::size_t k = 0; k < 3; ++k) {
    const DerivedVertex& vertex = vertices[k];
    views[k] = {vertex.view.x, vertex.view.y, vertex.view.z, vertex.texcoord.x, vertex.texcoord.y};
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

// --- rules 4 to 6: the piece of a triangle that shows at a sample ---

struct Piece {
  int number = 0, count = 0;
  std::array<ViewVertex, 3> corners;
  raster::ScreenTriangle screen;
  std::array<Rational, 3> weights;
  Rational inverseDepth;
};

bool covers(const raster::ScreenTriangle& triangle, int column, int row) {
  return std::all_of(triangle.edges.begin(), triangle.edges.end(),
                     [=](const raster::Edge& edge) { return edge.at(column, row) >= (edge.inclusive ? 0 : 1); });
}

void interpolate(Piece& piece, int column, int row) {
  for (std::size_t k = 0; k < 3; ++k) {
    piece.weights[k] = Rational(piece.screen.edges[k].at(column, row)) / Rational(piece.screen.area);
    piece.inverseDepth += piece.weights[k] / Rational(piece.corners[k].w);
  }
}

/// The piece of a triangle with the largest 1/w of those that cover the sample; some do.
Piece pieceAt(const raster::Face& face, const std::array<ViewVertex, 3>& vertices, int column, int row) {
  const bool mirrored = raster::determinant(face) < 0;
  const raster::ClippedPolygon polygon = raster::clip(vertices, face.nearDistance);
  Piece nearest;
  for (int k = 2; k < polygon.count; ++k) {
    const auto corner = static_cast<std::size_t>(k);
    Piece piece;
    piece.number = k - 2;
    piece.count = polygon.count - 2;
    piece.corners = {polygon.vertices[0], polygon.vertices[corner - 1], polygon.vertices[corner]};
    if (!raster::makeScreenTriangle(face, piece.corners, mirrored, piece.screen)) continue;
    if (!covers(piece.screen, column, row)) continue;
    interpolate(piece, column, row);
    if (nearest.count == 0 || piece.inverseDepth > nearest.inverseDepth) nearest = piece;
  }
  assert(nearest.count > 0);
  return nearest;
}

/// u or v at the sample.
Rational coordinateAt(const Piece& piece, double ViewVertex::*coordinate) {
  Rational sum;
  for (std::size_t k = 0; k < 3; ++k)
    sum += piece.weights[k] * Rational(piece.corners[k].*coordinate) / Rational(piece.corners[k].w);
  return sum / piece.inverseDepth;
}

DerivedCorner cornerOf(const ViewVertex& view, int resolution) {
  const glm::dvec2 q(view.x / view.w, view.y / view.w);
  return {view, q, {raster::snap(q.x, resolution), raster::snap(q.y, resolution)}};
}

std::int64_t signedArea(const std::array<DerivedCorner, 3>& corners) {
  const glm::i64vec2 p(corners[1].snapped - corners[0].snapped), q(corners[2].snapped - corners[0].snapped);
  return p.x * q.y - p.y * q.x;
}

DerivedEdge edgeAt(const raster::Edge& edge, int column, int row) {
  const EdgeKind kind = !edge.inclusive ? EdgeKind::Other : edge.a > 0 ? EdgeKind::Left : EdgeKind::Top;
  return {edge.at(column, row), kind};
}

// --- rules 6 and 7: texel and blend ---

int floorWithin(const Rational& position, int size) {
  if (position < 0) return 0;
  const boost::multiprecision::cpp_int whole = numerator(position) / denominator(position);
  return whole >= size ? size - 1 : whole.convert_to<int>();
}

DerivedTexel texelAt(const raster::IndexMap& map, const Rational& u, const Rational& v) {
  const Rational column = u * map.width, row = v * map.height;
  const Texel texel{floorWithin(column, map.width), floorWithin(row, map.height)};
  const auto index = static_cast<std::size_t>(texel.row) * static_cast<std::size_t>(map.width) +
                     static_cast<std::size_t>(texel.column);
  return {map.width, map.height, {column.convert_to<double>(), row.convert_to<double>()}, texel, map.ids[index]};
}

std::vector<DerivedSum> sumsOf(const raster::DrawList& list, raster::ItemId offset, raster::ItemId texel) {
  std::vector<DerivedSum> sums;
  if (list.blend == raster::Blend::Replace) return sums;
  const bool isClamped = list.blend == raster::Blend::ClampedAdd;
  int shift = 0;
  for (const int bits : isClamped ? list.format.channelBits : std::vector<int>{raster::idBits(list.format)}) {
    const std::uint64_t largest = (std::uint64_t{1} << bits) - 1;
    DerivedSum sum{bits, (offset >> shift) & largest, (texel >> shift) & largest, 0};
    sum.result = isClamped ? std::min(sum.offset + sum.texel, largest) : (sum.offset + sum.texel) & largest;
    sums.push_back(sum);
    shift += bits;
  }
  return sums;
}

/// The results of the sums side by side, the first in the least significant bits.
raster::ItemId joined(const std::vector<DerivedSum>& sums) {
  std::uint64_t id = 0;
  int shift = 0;
  for (const DerivedSum& sum : sums) {
    id |= sum.result << shift;
    shift += sum.bits;
  }
  return static_cast<raster::ItemId>(id);
}

void deriveId(const raster::DrawList& list, const Rational& u, const Rational& v, Derivation& derivation) {
  const raster::Draw& draw = list.draws[derivation.drawn.draw];
  const bool isBack = derivation.facesAway && draw.back;
  derivation.id = isBack ? *draw.back : draw.offset;
  if (isBack || !draw.indexMap) return;
  derivation.texel = texelAt(list.indexMaps[static_cast<std::size_t>(*draw.indexMap)], u, v);
  derivation.sums = sumsOf(list, draw.offset, derivation.texel->index);
  derivation.id = derivation.sums.empty() ? derivation.texel->index : joined(derivation.sums);
}

/// The first fragment behind the visible one that is of another triangle.
std::optional<RunnerUp> runnerUpOf(const raster::DrawList& list, const raster::Face& face,
                                   const std::vector<Fragment>& fragments, const Piece& visible, int column, int row) {
  const Fragment& front = fragments.front();
  const auto other = std::find_if(fragments.begin(), fragments.end(), [&](const Fragment& fragment) {
    return fragment.triangle != front.triangle || fragment.draw != front.draw;
  });
  if (other == fragments.end()) return {};
  const Piece piece = pieceAt(face, widened(verticesOf(list, face, other->triangle)), column, row);
  const Rational difference = visible.inverseDepth - piece.inverseDepth;
  return RunnerUp{
      {other->draw, other->triangle}, piece.inverseDepth.convert_to<double>(), difference.convert_to<double>()};
}

}  // namespace

std::optional<Derivation> derive(const raster::DrawList& list, const raster::Face& face, int column, int row) {
  const std::vector<Fragment> fragments = fragmentsAt(list, face, column, row);
  if (fragments.empty()) return {};
  Derivation derivation;
  derivation.drawn = {fragments.front().draw, fragments.front().triangle};
  derivation.vertices = verticesOf(list, face, derivation.drawn.triangle);
  const std::array<ViewVertex, 3> views = widened(derivation.vertices);
  derivation.cutBy = cutsOf(views, face.nearDistance);

  const Piece piece = pieceAt(face, views, column, row);
  derivation.piece = piece.number;
  derivation.pieces = piece.count;
  derivation.sample = {256 * column + 128, 256 * row + 128};
  derivation.facesAway = piece.screen.facesAway;
  for (std::size_t k = 0; k < 3; ++k) {
    derivation.corners[k] = cornerOf(piece.corners[k], face.resolution);
    derivation.edges[k] = edgeAt(piece.screen.edges[k], column, row);
    derivation.weights[k] = piece.weights[k].convert_to<double>();
  }
  derivation.area = signedArea(derivation.corners);
  derivation.inverseDepth = piece.inverseDepth.convert_to<double>();
  const Rational u = coordinateAt(piece, &ViewVertex::u), v = coordinateAt(piece, &ViewVertex::v);
  derivation.coordinates = {u.convert_to<double>(), v.convert_to<double>()};
  deriveId(list, u, v, derivation);
  derivation.runnerUp = runnerUpOf(list, face, fragments, piece, column, row);
  return derivation;
}

}  // namespace hemitex::reference
