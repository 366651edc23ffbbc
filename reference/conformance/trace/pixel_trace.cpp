#include "reference/conformance/trace/pixel_trace.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdlib>

#include "reference/conformance/vectors/colour_channels.h"

namespace hemitex::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using raster::SnappedTriangle;
using raster::ViewVertex;

// --- vertices and clipping ---

DerivedVertex vertexOf(const raster::DrawList& list, const raster::Face& face, std::uint32_t index,
                       const ViewVertex& view) {
  const glm::vec3 position = list.positions[index];
  return {index, position, position - face.eye, {view.x, view.y, view.w}, list.texcoords[index]};
}

DerivedCorner cornerOf(const ViewVertex& view, const raster::SnappedPoint& snapped) {
  return {view, {view.x / view.w, view.y / view.w}, {snapped.x, snapped.y}};
}

/// Stores the vertices of the visible triangle, and what clipping leaves of them.
void deriveTriangle(const raster::DrawList& list, const raster::Face& face, Derivation& derivation) {
  const SnappedTriangle& screen = derivation.visible.screen;
  const std::array<ViewVertex, 3> views = raster::view(face, list, screen.number);
  for (std::size_t k = 0; k < 3; ++k) {
    derivation.vertices[k] = vertexOf(list, face, list.indices[3 * std::size_t{screen.number} + k], views[k]);
    derivation.corners[k] = cornerOf(screen.vertices[k], screen.corners[k]);
  }
  for (const raster::ClipPlane plane : raster::clipPlanes(list.clipDepth))
    if (raster::cuts(plane, views, face.nearDistance)) derivation.cutBy.push_back(plane);
  derivation.piece = screen.piece;
  derivation.pieces = static_cast<int>(raster::clip(views, face.nearDistance, list.clipDepth).count) - 2;
  derivation.area = screen.area;
}

// --- the fragment of a triangle at a sample ---

using OverDepth = std::array<Rational, 3>;

OverDepth overDepthOf(const SnappedTriangle& triangle, int column, int row) {
  return raster::weightsOverDepth<Rational>(triangle, weightsAt(triangle, raster::sampleOf(column, row)));
}

/// The depth of a triangle at a sample that is not 1/w.
std::optional<double> ownDepth(const raster::DrawList& list, const SnappedTriangle& triangle, int column, int row) {
  if (list.clipDepth == raster::ClipDepth::None && list.depthPrecision == raster::DepthPrecision::Exact) return {};
  return coveredSample(triangle, weightsAt(triangle, raster::sampleOf(column, row))).depth;
}

void deriveEdges(const raster::Weights& weights, Derivation& derivation) {
  const SnappedTriangle& screen = derivation.visible.screen;
  for (std::size_t k = 0; k < 3; ++k) {
    derivation.edges[k] = {weights[k], kindOf(directionOf(screen, k))};
    derivation.weights[k] = static_cast<double>(weights[k]) / static_cast<double>(std::abs(screen.area));
  }
}

// --- texel and blend ---

std::vector<DerivedSum> sumsOf(const raster::DrawList& list, raster::ItemId offset, raster::ItemId texel,
                               raster::ItemId id) {
  std::vector<DerivedSum> sums;
  if (list.blend == raster::Blend::Replace) return sums;
  const bool isClamped = list.blend == raster::Blend::ClampedAdd;
  for (const Channel& channel :
       isClamped ? channelsOf(list.format) : std::vector{Channel{0, raster::idBits(list.format)}})
    sums.push_back({channel.bits, channel.of(offset), channel.of(texel), channel.of(id)});
  return sums;
}

void deriveId(const raster::DrawList& list, const Rational& u, const Rational& v, Derivation& derivation) {
  const Fragment& visible = derivation.visible;
  if (!visible.texel) return;
  const raster::Draw& draw = list.draws[visible.draw];
  const raster::IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const raster::ItemId index = raster::indexAt(list, draw, *visible.texel);
  const Rational column = u * map.width, row = v * map.height;
  derivation.texel = {map.width, map.height, {column.convert_to<double>(), row.convert_to<double>()}, index};
  derivation.sums = sumsOf(list, draw.offset, index, visible.id);
}

/// The first fragment behind the visible one that is of another triangle.
std::optional<RunnerUp> runnerUpOf(const raster::DrawList& list, const std::vector<Fragment>& fragments,
                                   const Rational& inverseDepth, int column, int row) {
  const Fragment& front = fragments.front();
  const auto other = std::find_if(fragments.begin(), fragments.end(), [&](const Fragment& fragment) {
    return fragment.triangle != front.triangle || fragment.draw != front.draw;
  });
  if (other == fragments.end()) return {};
  const Rational behind = raster::inverseDepth(overDepthOf(other->screen, column, row));
  const Rational difference = inverseDepth - behind;
  return RunnerUp{{other->draw, other->triangle},
                  behind.convert_to<double>(),
                  difference.convert_to<double>(),
                  ownDepth(list, other->screen, column, row)};
}

}  // namespace

std::optional<Derivation> derive(const raster::DrawList& list, const raster::Face& face,
                                 const std::vector<Fragment>& fragments, int column, int row) {
  if (fragments.empty()) return {};
  Derivation derivation;
  derivation.visible = fragments.front();
  const SnappedTriangle& screen = derivation.visible.screen;
  deriveTriangle(list, face, derivation);
  derivation.sample = {256 * column + 128, 256 * row + 128};
  deriveEdges(weightsAt(screen, raster::sampleOf(column, row)), derivation);
  const OverDepth overDepth = overDepthOf(screen, column, row);
  const Rational inverseDepth = raster::inverseDepth(overDepth);
  const Rational u = raster::interpolated(screen, overDepth, &ViewVertex::u);
  const Rational v = raster::interpolated(screen, overDepth, &ViewVertex::v);
  derivation.inverseDepth = inverseDepth.convert_to<double>();
  derivation.depth = ownDepth(list, screen, column, row);
  derivation.coordinates = {u.convert_to<double>(), v.convert_to<double>()};
  deriveId(list, u, v, derivation);
  derivation.runnerUp = runnerUpOf(list, fragments, inverseDepth, column, row);
  return derivation;
}

}  // namespace hemitex::reference
