/// The rules of docs/item-buffers.md as functions, to read from top to bottom in the order of that page: view, clip,
/// snap, cover and facing, depth, texel, blend. PlainRenderer (plain_renderer.h) draws with them. The trace of a pixel
/// records their results, and a simulated device with a fault replaces one of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::raster {

// ------------------------------------------------------------------------------------------------------------- 1. view

/// A vertex as the eye sees it: x to the right, y towards larger rows and w forward, with its texture coordinate. The
/// picture plane is w = 1, and shows x/w and y/w. The depth is z/w, and nearer points have the smaller one. Views have
/// no z of their own: with -1 the depth is -1/w.
struct ViewVertex {
  double x, y, w;
  double u, v;
  double z = -1;
};

/// The rules fix the rounding of this step: single precision, in this order of operations.
inline ViewVertex view(const Face& face, const glm::vec3& position, const glm::vec2& texcoord) {
  const glm::vec3 d = position - face.eye;
  const auto along = [&](const glm::vec3& row) { return (row.x * d.x + row.y * d.y) + row.z * d.z; };
  return {along(face.x), along(face.y), along(face.w), texcoord.x, texcoord.y};
}

/// A vertex of a list. In clip space the rows of the face apply to x, y and w, and z stays.
inline ViewVertex viewedVertex(const Face& face, const DrawList& list, std::size_t index) {
  ViewVertex vertex = view(face, list.positions[index], list.texcoords[index]);
  if (list.clipDepth != ClipDepth::None) vertex.z = static_cast<double>(list.clipZ[index]);
  return vertex;
}

/// The vertices of triangle t of a list, with indices 3t to 3t + 2.
inline std::array<ViewVertex, 3> view(const Face& face, const DrawList& list, std::uint32_t t) {
  const auto vertex = [&](std::size_t k) { return viewedVertex(face, list, list.indices[3 * std::size_t{t} + k]); };
  return {vertex(0), vertex(1), vertex(2)};
}

/// A triangle with a value that is not finite is not drawn.
inline bool isFinite(const ViewVertex& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.w) && std::isfinite(p.u) && std::isfinite(p.v) &&
         std::isfinite(p.z);
}
inline bool areFinite(const std::array<ViewVertex, 3>& p) { return isFinite(p[0]) && isFinite(p[1]) && isFinite(p[2]); }

// ------------------------------------------------------------------------------------------------------------- 2. clip

/// The planes that clip: the near plane, those of z in clip space, and a guard band of eight times the picture, which
/// keeps the integers of the next step small. In clip space the near plane is that of the smallest w.
enum class ClipPlane { Near, ZeroZ, LeastZ, LargestZ, Right, Left, Upper, Lower };
inline constexpr double guardBand = 8;

/// The planes of a list, in the order of clipping.
inline std::span<const ClipPlane> clipPlanes(ClipDepth depth) {
  using enum ClipPlane;
  static constexpr std::array scene{Near, Right, Left, Upper, Lower};
  static constexpr std::array zeroToOne{Near, ZeroZ, LargestZ, Right, Left, Upper, Lower};
  static constexpr std::array minusOneToOne{Near, LeastZ, LargestZ, Right, Left, Upper, Lower};
  switch (depth) {
    case ClipDepth::None:
      return scene;
    case ClipDepth::ZeroToOne:
      return zeroToOne;
    default:
      return minusOneToOne;
  }
}

/// At least 0 inside.
inline double distance(ClipPlane plane, const ViewVertex& p, double nearDistance) {
  switch (plane) {
    case ClipPlane::Near:
      return p.w - nearDistance;
    case ClipPlane::ZeroZ:
      return p.z;
    case ClipPlane::LeastZ:
      return p.w + p.z;
    case ClipPlane::LargestZ:
      return p.w - p.z;
    case ClipPlane::Right:
      return guardBand * p.w - p.x;
    case ClipPlane::Left:
      return guardBand * p.w + p.x;
    case ClipPlane::Upper:
      return guardBand * p.w - p.y;
    default:
      return guardBand * p.w + p.y;
  }
}

/// The point where an edge leaves the inside. Computed from the inside end, it is the same for both triangles that
/// share the edge.
inline ViewVertex crossing(ClipPlane plane, const ViewVertex& a, const ViewVertex& b, double nearDistance) {
  const double fromA = distance(plane, a, nearDistance);
  const double t = fromA / (fromA - distance(plane, b, nearDistance));
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  const double w = plane == ClipPlane::Near ? nearDistance : std::max(between(a.w, b.w), nearDistance);
  return {between(a.x, b.x), between(a.y, b.y), w, between(a.u, b.u), between(a.v, b.v), between(a.z, b.z)};
}

/// A convex polygon; without vertices if nothing is left. Each plane adds at most one vertex. Rounding can make the
/// polygon slightly non-convex; then a plane multiplies their number by at most 3/2: 3, 4, 6, 9, 13, 19, 28, 42.
struct ClippedPolygon {
  std::array<ViewVertex, 42> vertices;
  std::size_t count = 0;

  void add(const ViewVertex& vertex) { vertices[count++] = vertex; }
  const ViewVertex* begin() const { return vertices.data(); }
  const ViewVertex* end() const { return vertices.data() + count; }
};

/// The part of a polygon inside a plane (Sutherland and Hodgman 1974).
inline ClippedPolygon clip(const ClippedPolygon& polygon, ClipPlane plane, double nearDistance) {
  ClippedPolygon inside;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ViewVertex &start = polygon.vertices[i], &end = polygon.vertices[(i + 1) % polygon.count];
    const bool startsInside = distance(plane, start, nearDistance) >= 0;
    const bool endsInside = distance(plane, end, nearDistance) >= 0;
    if (startsInside) inside.add(start);
    if (startsInside && !endsInside) inside.add(crossing(plane, start, end, nearDistance));
    if (!startsInside && endsInside) inside.add(crossing(plane, end, start, nearDistance));
  }
  return inside;
}

/// Whether a plane cuts off a vertex.
template <typename Vertices>
bool cuts(ClipPlane plane, const Vertices& vertices, double nearDistance) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](const ViewVertex& p) { return distance(plane, p, nearDistance) < 0; });
}

/// The part of a triangle inside all planes. Its values are finite.
inline ClippedPolygon clip(const std::array<ViewVertex, 3>& triangle, double nearDistance,
                           ClipDepth depth = ClipDepth::None) {
  ClippedPolygon polygon;
  for (const ViewVertex& vertex : triangle) polygon.add(vertex);
  for (const ClipPlane plane : clipPlanes(depth))
    if (cuts(plane, polygon, nearDistance)) polygon = clip(polygon, plane, nearDistance);
  return polygon;
}

/// What remains of triangle t of a list; nothing if a value is not finite.
inline ClippedPolygon clip(const Face& face, const DrawList& list, std::uint32_t t) {
  const std::array<ViewVertex, 3> vertices = view(face, list, t);
  return areFinite(vertices) ? clip(vertices, face.nearDistance, list.clipDepth) : ClippedPolygon{};
}

/// A polygon is drawn as a fan of triangles around its first vertex. This is the one that ends at vertex k, from 2 on.
inline std::array<ViewVertex, 3> fanTriangle(const ClippedPolygon& polygon, std::size_t k) {
  return {polygon.vertices[0], polygon.vertices[k - 1], polygon.vertices[k]};
}

// ------------------------------------------------------------------------------------------------------------- 3. snap

/// A point of the picture in units of 1/256 pixel. From here on, coverage is a matter of integers.
struct SnappedPoint {
  std::int64_t x, y;
};

/// The place of q = x/w or y/w in units of 1/256 pixel, not yet rounded. `resolution` is the number of pixels of the
/// viewport along that axis. The clamp removes the rounding error of
/// clipping.
inline double subPixels(double q, int resolution) {
  return (std::clamp(q, -guardBand, guardBand) + 1) * (128.0 * resolution);
}

inline std::int64_t snap(double q, int resolution) {
  return static_cast<std::int64_t>(std::nearbyint(subPixels(q, resolution)));
}

inline SnappedPoint snap(const ViewVertex& p, int resolution) {
  return {snap(p.x / p.w, resolution), snap(p.y / p.w, resolution)};
}

/// The corner of a triangle on the picture of a face. Samples at the corners of pixels are the same as samples in the
/// middle of a picture that is moved by half a pixel.
inline SnappedPoint snap(const Face& face, const ViewVertex& p) {
  const Viewport viewport = viewportOf(face);
  const std::int64_t moved = face.sample == SamplePlace::Corner ? 128 : 0;
  return {snap(p.x / p.w, viewport.columns) + moved, snap(p.y / p.w, viewport.rows) + moved};
}

/// The sample of a pixel is its centre. Rows count in memory order: row 0 is at y = -w.
inline SnappedPoint sampleOf(int column, int row) {
  return {256 * std::int64_t{column} + 128, 256 * std::int64_t{row} + 128};
}

// ----------------------------------------------------------------------------------------------- 4. cover, and facing

/// Twice the signed area of the triangle a, b, p: the edge function of a and b (Pineda 1988). Its sign tells the side
/// of the edge that p is on.
inline std::int64_t edgeFunction(const SnappedPoint& a, const SnappedPoint& b, const SnappedPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// How the depth d of a list is stored: d = scale z/w + offset, from 0 to 1.
struct DepthRule {
  DepthPrecision precision = DepthPrecision::Exact;
  double scale = 1, offset = 0;
};

inline DepthRule depthRuleOf(const DrawList& list, const Face& face) {
  switch (list.clipDepth) {
    case ClipDepth::None:
      return {list.depthPrecision, static_cast<double>(face.nearDistance), 1};  // 1 - n/w
    case ClipDepth::ZeroToOne:
      return {list.depthPrecision, 1, 0};
    default:
      return {list.depthPrecision, 0.5, 0.5};
  }
}

/// A triangle on the picture.
struct SnappedTriangle {
  std::uint32_t draw = 0;    ///< in DrawList::draws
  std::uint32_t number = 0;  ///< in DrawList::indices / 3
  int piece = 0;             ///< of the fan that clipping leaves of it
  std::array<ViewVertex, 3> vertices = {};
  std::array<SnappedPoint, 3> corners = {};
  std::int64_t area = 0;   ///< twice its signed area; a triangle without area is not drawn
  bool facesAway = false;  ///< from the eye
  DepthRule depthRule = {};

  /// 1 or -1: an edge function times this is positive inside.
  std::int64_t sign() const { return area > 0 ? 1 : -1; }
};

/// The triangle of three vertices and their corners on the picture, with its area and facing.
inline SnappedTriangle snappedTriangle(const DrawList& list, const Face& face,
                                       const std::array<ViewVertex, 3>& vertices,
                                       const std::array<SnappedPoint, 3>& corners) {
  SnappedTriangle triangle{.vertices = vertices, .corners = corners};
  triangle.area = edgeFunction(corners[0], corners[1], corners[2]);
  const bool isClockwise = (triangle.area > 0) == (determinant(face) > 0);
  triangle.facesAway = isClockwise != (list.front == Winding::Clockwise);
  triangle.depthRule = depthRuleOf(list, face);
  return triangle;
}

/// Whether a draw culls triangles of this facing. A culled triangle does not exist.
inline bool isCulled(const Draw& draw, bool facesAway) { return draw.cull == (facesAway ? Cull::Back : Cull::Front); }

/// The edge functions of a sample: those of the edges opposite to each corner, and positive inside. Divided by their
/// sum they are the barycentric weights of the corners.
using Weights = std::array<std::int64_t, 3>;

inline Weights weightsAt(const SnappedTriangle& triangle, const SnappedPoint& sample) {
  const auto& [a, b, c] = triangle.corners;
  const std::int64_t sign = triangle.sign();
  return {sign * edgeFunction(b, c, sample), sign * edgeFunction(c, a, sample), sign * edgeFunction(a, b, sample)};
}

/// The direction of the edge opposite to corner k, with the interior on its right where rows grow downwards.
inline SnappedPoint directionOf(const SnappedTriangle& triangle, std::size_t k) {
  const SnappedPoint &a = triangle.corners[(k + 1) % 3], &b = triangle.corners[(k + 2) % 3];
  return {triangle.sign() * (b.x - a.x), triangle.sign() * (b.y - a.y)};
}

/// A top edge is horizontal, with the interior at larger rows; a left edge has the interior at larger columns.
enum class EdgeKind { Top, Left, Other };

inline EdgeKind kindOf(const SnappedPoint& direction) {
  if (direction.y == 0) return direction.x > 0 ? EdgeKind::Top : EdgeKind::Other;
  return direction.y < 0 ? EdgeKind::Left : EdgeKind::Other;
}

/// A sample on an edge belongs to one of the triangles that share it: the one whose top or left edge it is.
inline bool ownsSamples(const SnappedPoint& direction) { return kindOf(direction) != EdgeKind::Other; }

/// Whether a triangle covers the sample with these weights. `owns` decides where the sample is on an edge.
template <typename Owns>
bool covers(const SnappedTriangle& triangle, const Weights& weights, const Owns& owns) {
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[k] < 0 || (weights[k] == 0 && !owns(directionOf(triangle, k)))) return false;
  return true;
}

inline bool covers(const SnappedTriangle& triangle, const Weights& weights) {
  return covers(triangle, weights, ownsSamples);
}

/// The pixels [first, end).
struct PixelRange {
  int first, end;
};

/// The pixels of [first, end) whose samples lie between the smallest and the largest of three snapped positions.
template <typename Integer>
PixelRange samplesBetween(Integer a, Integer b, Integer c, int first, int end) {
  const Integer low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
  return {static_cast<int>(std::max<Integer>(first, (low + 127) >> 8)),
          static_cast<int>(std::min<Integer>(end, (high + 128) >> 8))};
}

// --------------------------------------------------------------------------------------------- 5. depth, and 6. texel

// Depths and texels are those of exact arithmetic: `Number` below is double or a rational number. Double precision
// finds nearly all. The sums below have terms of one sign, or terms up to the largest coordinate, and at most 13
// roundings of 2^-53 (a depth has five, so that this also bounds a difference of two). Where an error of 2^-49 could
// change the answer, rational numbers decide (rules.cpp).
constexpr double roundingError = 0x1p-49;

/// b_k / w_k, the barycentric weights over the depths of the corners. These are linear on the picture.
template <typename Number>
std::array<Number, 3> weightsOverDepth(const SnappedTriangle& triangle, const Weights& weights) {
  const auto over = [&](std::size_t k) -> Number {
    return Number(weights[k]) * Number(1 / Number(triangle.vertices[k].w) / Number(triangle.sign() * triangle.area));
  };
  return {over(0), over(1), over(2)};
}

/// 1/w at a sample: larger for nearer points.
template <typename Number>
Number inverseDepth(const std::array<Number, 3>& overDepth) {
  return overDepth[0] + overDepth[1] + overDepth[2];
}

/// u or v at a sample, with perspective: u/w and 1/w are linear on the picture, and u is their quotient.
template <typename Number>
Number interpolated(const SnappedTriangle& triangle, const std::array<Number, 3>& overDepth,
                    double ViewVertex::*coordinate) {
  Number sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += overDepth[k] * Number(triangle.vertices[k].*coordinate);
  return sum / inverseDepth(overDepth);
}

/// A sample that a triangle covers; `triangle` is null for the background.
struct CoveredSample {
  const SnappedTriangle* triangle = nullptr;
  Weights weights = {};
  double inverseDepth = 0;
  double depth = 0, depthError = 0;  ///< z/w, up to an error; or the stored depth
  ItemId passed = 0;                 ///< fragments that passed the depth test at the pixel, this one included
};

/// z/w at a sample: smaller for nearer points.
template <typename Number>
Number depthOf(const SnappedTriangle& triangle, const std::array<Number, 3>& overDepth) {
  const auto term = [&](std::size_t k) -> Number { return overDepth[k] * Number(triangle.vertices[k].z); };
  return term(0) + term(1) + term(2);
}

/// The number of a precision next to a depth from 0 to 1.
inline double rounded(DepthPrecision precision, double depth) {
  if (precision == DepthPrecision::Float32) return static_cast<double>(static_cast<float>(depth));
  const double steps = precision == DepthPrecision::Unorm16 ? 0xffff : 0xffffff;
  return std::nearbyint(depth * steps) / steps;
}

double storedDepthExactly(const SnappedTriangle& triangle, const Weights& weights);

/// The depth that a precision stores, where z/w is known up to an error.
inline double storedDepth(const SnappedTriangle& triangle, const Weights& weights, double depth, double error) {
  const DepthRule& rule = triangle.depthRule;
  const double middle = rule.scale * depth + rule.offset, around = rule.scale * error + roundingError;
  const auto roundedAt = [&](double d) { return rounded(rule.precision, std::clamp(d, 0.0, 1.0)); };
  const double low = roundedAt(middle - around), high = roundedAt(middle + around);
  return low == high ? low : storedDepthExactly(triangle, weights);
}

inline CoveredSample coveredSample(const SnappedTriangle& triangle, const Weights& weights) {
  const auto overDepth = weightsOverDepth<double>(triangle, weights);
  CoveredSample sample{&triangle, weights, inverseDepth(overDepth), depthOf(triangle, overDepth)};
  for (std::size_t k = 0; k < 3; ++k)
    sample.depthError += roundingError * std::abs(overDepth[k] * triangle.vertices[k].z);
  if (triangle.depthRule.precision == DepthPrecision::Exact) return sample;
  sample.depth = storedDepth(triangle, weights, sample.depth, sample.depthError);
  sample.depthError = 0;
  return sample;
}

bool isNearerExactly(const CoveredSample& a, const CoveredSample& b);

/// Whether `a` is nearer than `b` at the same sample. Of equal depths neither is, and the earlier triangle stays.
inline bool isNearer(const CoveredSample& a, const CoveredSample& b) {
  const double difference = b.depth - a.depth;
  const bool isSure = std::abs(difference) > a.depthError + b.depthError;
  return isSure || a.triangle->depthRule.precision != DepthPrecision::Exact ? difference > 0 : isNearerExactly(a, b);
}

/// Whether a fragment passes the depth test of a list against the one that its pixel shows. `nearer(x, y)` tells
/// whether x is nearer than y.
template <typename Sample, typename Nearer>
bool passes(DepthTest test, const Sample& fragment, const Sample& shown, const Nearer& nearer) {
  switch (test) {
    case DepthTest::Nearer:
      return nearer(fragment, shown);
    case DepthTest::NearerOrEqual:
      return !nearer(shown, fragment);
    case DepthTest::Farther:
      return nearer(shown, fragment);
    default:
      return !nearer(fragment, shown);
  }
}

int texelExactly(const CoveredSample& sample, double ViewVertex::*coordinate, int size);

/// The column or row of the texel at a coordinate: floor(u N), clamped to the map.
inline int texelAt(const CoveredSample& sample, double ViewVertex::*coordinate, int size) {
  const SnappedTriangle& triangle = *sample.triangle;
  double largest = 0;
  for (const ViewVertex& vertex : triangle.vertices) largest = std::max(largest, std::abs(vertex.*coordinate));
  const auto overDepth = weightsOverDepth<double>(triangle, sample.weights);
  const double place = interpolated(triangle, overDepth, coordinate) * size, error = roundingError * largest * size;
  const auto clamped = [size](double texel) { return static_cast<int>(std::clamp(texel, 0.0, size - 1.0)); };
  const int low = clamped(std::floor(place - error)), high = clamped(std::floor(place + error));
  return low == high ? low : texelExactly(sample, coordinate, size);
}

struct Texel {
  int column = 0;
  int row = 0;
  bool operator==(const Texel&) const = default;
};

/// The texel of a sample in an index map.
inline Texel texelIn(const IndexMap& map, const CoveredSample& sample) {
  return {texelAt(sample, &ViewVertex::u, map.width), texelAt(sample, &ViewVertex::v, map.height)};
}

/// The index map of a draw that has one.
inline const IndexMap& mapOf(const DrawList& list, const Draw& draw) {
  return list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
}

/// The index that the map of a draw holds at a texel.
inline ItemId indexAt(const DrawList& list, const Draw& draw, const Texel& texel) {
  const IndexMap& map = mapOf(list, draw);
  return map.ids[static_cast<std::size_t>(texel.row) * static_cast<std::size_t>(map.width) +
                 static_cast<std::size_t>(texel.column)];
}

/// Whether a sample meets a hole of its index map, which is open from both sides. Its fragment is discarded: it takes
/// no part in the depth test.
inline bool isHole(const DrawList& list, const CoveredSample& sample) {
  const Draw& draw = list.draws[sample.triangle->draw];
  return draw.indexMap && indexAt(list, draw, texelIn(mapOf(list, draw), sample)) == holeTexel;
}

// ------------------------------------------------------------------------------------------------------------ 7. blend

/// The texel that gives a sample its item ID; none without an index map, on a back, or where pixels hold no item IDs.
inline std::optional<Texel> texelOf(const DrawList& list, const CoveredSample& sample) {
  const Draw& draw = list.draws[sample.triangle->draw];
  const bool isTextured = draw.indexMap && list.value == PixelValue::ItemIds;
  if (!isTextured || (sample.triangle->facesAway && draw.back)) return {};
  return texelIn(mapOf(list, draw), sample);
}

/// The idea of the paper: the item ID is the offset of the surface plus the index of the texel. `blend` (item_id.h)
/// adds channel by channel, min(offset + index, maximum), as a blend unit does.
inline ItemId itemId(const DrawList& list, const SnappedTriangle& triangle, const std::optional<Texel>& texel) {
  const Draw& draw = list.draws[triangle.draw];
  if (triangle.facesAway && draw.back) return *draw.back;
  if (list.value != PixelValue::ItemIds) return flatValue(list, draw, triangle.number);
  return texel ? blend(list.format, list.blend, draw.offset, indexAt(list, draw, *texel)) : draw.offset;
}

/// The value of a pixel, of what it shows.
inline ItemId pixelValue(const DrawList& list, const CoveredSample& shown) {
  if (list.value == PixelValue::PassedSamples) return shown.passed;
  if (!shown.triangle) return backgroundId(list.format);
  return itemId(list, *shown.triangle, texelOf(list, shown));
}

}  // namespace hemitex::raster
