#include "raster/plain/plain_renderer.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <utility>

namespace hemitex::raster {
namespace {

// ------------------------------------------------------------------------------------------------------------- 1. view

/// A vertex as the eye sees it: to the right, up and forward, with its texture coordinates.
struct ViewVertex {
  double x, y, w, u, v;
};

/// The rules fix the rounding of this step: single precision, in this order of operations.
ViewVertex view(const Face& face, const glm::vec3& position, const glm::vec2& texcoord) {
  const glm::vec3 d = position - face.eye;
  const auto along = [&](const glm::vec3& row) { return (row.x * d.x + row.y * d.y) + row.z * d.z; };
  return {along(face.x), along(face.y), along(face.w), texcoord.x, texcoord.y};
}

bool isFinite(const ViewVertex& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.w) && std::isfinite(p.u) && std::isfinite(p.v);
}

// ------------------------------------------------------------------------------------------------------------- 2. clip

/// The planes that clip: the near plane, and a guard band of eight times the picture, which keeps the integers of the
/// next step small.
enum class Plane { Near, Right, Left, Upper, Lower };
constexpr std::array planes{Plane::Near, Plane::Right, Plane::Left, Plane::Upper, Plane::Lower};

/// At least 0 inside.
double distance(Plane plane, const ViewVertex& p, double nearDistance) {
  switch (plane) {
    case Plane::Near:
      return p.w - nearDistance;
    case Plane::Right:
      return 8 * p.w - p.x;
    case Plane::Left:
      return 8 * p.w + p.x;
    case Plane::Upper:
      return 8 * p.w - p.y;
    default:
      return 8 * p.w + p.y;
  }
}

/// The point where an edge leaves the inside. Computed from the inside end, it is the same for both triangles that
/// share the edge.
ViewVertex crossing(Plane plane, const ViewVertex& a, const ViewVertex& b, double nearDistance) {
  const double fromA = distance(plane, a, nearDistance);
  const double t = fromA / (fromA - distance(plane, b, nearDistance));
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  const double w = plane == Plane::Near ? nearDistance : std::max(between(a.w, b.w), nearDistance);
  return {between(a.x, b.x), between(a.y, b.y), w, between(a.u, b.u), between(a.v, b.v)};
}

/// The part of a polygon inside a plane (Sutherland and Hodgman 1974).
std::vector<ViewVertex> clip(const std::vector<ViewVertex>& polygon, Plane plane, double nearDistance) {
  std::vector<ViewVertex> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ViewVertex &start = polygon[i], &end = polygon[(i + 1) % polygon.size()];
    const bool startsInside = distance(plane, start, nearDistance) >= 0;
    const bool endsInside = distance(plane, end, nearDistance) >= 0;
    if (startsInside) inside.push_back(start);
    if (startsInside && !endsInside) inside.push_back(crossing(plane, start, end, nearDistance));
    if (!startsInside && endsInside) inside.push_back(crossing(plane, end, start, nearDistance));
  }
  return inside;
}

// ------------------------------------------------------------------------------------------------------------- 3. snap

/// A point of the picture in units of 1/256 pixel. From here on, coverage is a matter of integers.
struct SnappedPoint {
  std::int64_t x, y;
};

std::int64_t snapped(double clip, double w, int resolution) {
  return static_cast<std::int64_t>(std::nearbyint((std::clamp(clip / w, -8.0, 8.0) + 1) * (128.0 * resolution)));
}

/// The sample of a pixel is its centre.
SnappedPoint sampleOf(int column, int row) { return {256 * std::int64_t{column} + 128, 256 * std::int64_t{row} + 128}; }

// ------------------------------------------------------------------------------------------------- 4. cover, and
// facing

/// Twice the signed area of the triangle a, b, p: the edge function of a and b (Pineda 1988). Its sign tells the side
/// of the edge that p is on.
std::int64_t edge(const SnappedPoint& a, const SnappedPoint& b, const SnappedPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// A triangle on the picture, and the draw that it belongs to.
struct ScreenTriangle {
  const Draw* draw;
  std::array<ViewVertex, 3> vertex;
  std::array<SnappedPoint, 3> corner = {};
  std::int64_t area = 0;   ///< twice its signed area
  bool facesAway = false;  ///< from the eye
};

/// The edge functions of a sample: those of the edges opposite to each corner, and positive inside. Divided by their
/// sum they are the barycentric weights of the corners.
using Weights = std::array<std::int64_t, 3>;

Weights weightsAt(const ScreenTriangle& triangle, const SnappedPoint& sample) {
  const auto& [a, b, c] = triangle.corner;
  const std::int64_t sign = triangle.area > 0 ? 1 : -1;
  return {sign * edge(b, c, sample), sign * edge(c, a, sample), sign * edge(a, b, sample)};
}

/// A sample on an edge belongs to one of the triangles that share it: the one whose top edge (horizontal, with the
/// interior at larger rows; row 0 is the top in memory) or left edge (with the interior at larger columns) it is.
bool isTopOrLeft(const SnappedPoint& a, const SnappedPoint& b, std::int64_t area) {
  const std::int64_t columns = area > 0 ? b.x - a.x : a.x - b.x, rows = area > 0 ? b.y - a.y : a.y - b.y;
  return rows == 0 ? columns > 0 : rows < 0;
}

bool covers(const ScreenTriangle& triangle, const Weights& weights) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] < 0) return false;
    if (weights[k] == 0 && !isTopOrLeft(triangle.corner[(k + 1) % 3], triangle.corner[(k + 2) % 3], triangle.area))
      return false;
  }
  return true;
}

// --------------------------------------------------------------------------------------------- 5. depth, and 6. texel

// Depths and texels are those of exact arithmetic. Double precision finds nearly all: the sums below have terms of one
// sign, or terms up to the largest coordinate, and at most eleven roundings of 2^-53 (a depth has four, so that this
// also bounds a difference of two). Where an error of 2^-49 could change the answer, rational numbers decide.
using Rational = boost::multiprecision::cpp_rational;
constexpr double roundingError = 0x1p-49;

/// 1/w at a sample: linear on the picture, and larger for nearer points. `Number` is double or Rational.
template <typename Number>
Number inverseDepth(const ScreenTriangle& triangle, const Weights& weights) {
  Number sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += Number(weights[k]) / Number(triangle.vertex[k].w);
  return sum / Number(triangle.area > 0 ? triangle.area : -triangle.area);
}

/// u or v at a sample, with perspective: u/w and 1/w are linear on the picture, and u is their quotient.
template <typename Number>
Number interpolated(const ScreenTriangle& triangle, const Weights& weights, double ViewVertex::*coordinate) {
  Number sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += Number(weights[k]) * Number(triangle.vertex[k].*coordinate) / Number(triangle.vertex[k].w);
  return sum / Number(triangle.area > 0 ? triangle.area : -triangle.area) / inverseDepth<Number>(triangle, weights);
}

/// The visible point of a pixel; `triangle` is null where none is drawn yet.
struct Visible {
  const ScreenTriangle* triangle = nullptr;
  double inverseDepth = 0;
};

/// Whether a triangle is nearer at a sample than what its pixel shows. Of equal depths the earlier triangle stays.
bool isNearer(const ScreenTriangle& triangle, const Weights& weights, const SnappedPoint& sample, double inverse,
              const Visible& visible) {
  if (!visible.triangle) return true;
  if (std::abs(inverse - visible.inverseDepth) > roundingError * inverse) return inverse > visible.inverseDepth;
  return inverseDepth<Rational>(triangle, weights) >
         inverseDepth<Rational>(*visible.triangle, weightsAt(*visible.triangle, sample));
}

/// The column or row of the texel at a coordinate: floor(u N), clamped to the map.
int texelAt(const ScreenTriangle& triangle, const Weights& weights, double ViewVertex::*coordinate, int size) {
  const auto clamped = [size](double texel) { return static_cast<int>(std::clamp(texel, 0.0, size - 1.0)); };
  double largest = 0;
  for (const ViewVertex& vertex : triangle.vertex) largest = std::max(largest, std::abs(vertex.*coordinate));
  const double place = interpolated<double>(triangle, weights, coordinate) * size;
  const double error = roundingError * largest * size;
  const int low = clamped(std::floor(place - error)), high = clamped(std::floor(place + error));
  if (low == high) return low;
  const Rational exact = interpolated<Rational>(triangle, weights, coordinate) * size;
  if (exact < 0 || exact >= size) return exact < 0 ? 0 : size - 1;
  return static_cast<int>(numerator(exact) / denominator(exact));
}

// ------------------------------------------------------------------------------------------------------------ 7. blend

/// The idea of the paper: the item ID is the offset of the surface plus the index of the texel. `blend` (item_id.h)
/// adds channel by channel, min(offset + texel, maximum), as a blend unit does.
ItemId itemId(const DrawList& list, const ScreenTriangle& triangle, const Weights& weights) {
  const Draw& draw = *triangle.draw;
  if (triangle.facesAway && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const int column = texelAt(triangle, weights, &ViewVertex::u, map.width);
  const int row = texelAt(triangle, weights, &ViewVertex::v, map.height);
  const ItemId texel =
      map.ids[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(column)];
  return blend(list.format, list.blend, draw.offset, texel);
}

// --------------------------------------------------------------------------------------------------------------- faces

/// Appends what remains of one triangle of the list after clipping.
void append(std::vector<ScreenTriangle>& triangles, const DrawList& list, const Draw& draw, std::uint32_t firstIndex,
            const Face& face) {
  std::vector<ViewVertex> polygon;
  for (std::uint32_t i = firstIndex; i < firstIndex + 3; ++i)
    polygon.push_back(view(face, list.positions[list.indices[i]], list.texcoords[list.indices[i]]));
  if (!std::all_of(polygon.begin(), polygon.end(), isFinite)) return;
  for (const Plane plane : planes) polygon = clip(polygon, plane, face.nearDistance);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    ScreenTriangle triangle{&draw, {polygon[0], polygon[i - 1], polygon[i]}};
    for (std::size_t k = 0; k < 3; ++k) {
      const ViewVertex& p = triangle.vertex[k];
      triangle.corner[k] = {snapped(p.x, p.w, face.resolution), snapped(p.y, p.w, face.resolution)};
    }
    triangle.area = edge(triangle.corner[0], triangle.corner[1], triangle.corner[2]);
    triangle.facesAway = (triangle.area > 0) == (determinant(face) > 0);
    if (triangle.area != 0) triangles.push_back(triangle);
  }
}

/// Calls body(column, row) for the pixels of a scissor rectangle whose samples, at 256 i + 128, may lie in a triangle.
template <typename Body>
void forEachPixel(const ScreenTriangle& triangle, const Scissor& scissor, const Body& body) {
  const auto& [a, b, c] = triangle.corner;
  const auto first = [](std::int64_t low, int begin) { return std::max(static_cast<int>((low + 127) >> 8), begin); };
  const auto end = [](std::int64_t high, int last) { return std::min(static_cast<int>((high + 128) >> 8), last); };
  const int endColumn = end(std::max({a.x, b.x, c.x}), scissor.column + scissor.width);
  const int endRow = end(std::max({a.y, b.y, c.y}), scissor.row + scissor.height);
  for (int row = first(std::min({a.y, b.y, c.y}), scissor.row); row < endRow; ++row)
    for (int column = first(std::min({a.x, b.x, c.x}), scissor.column); column < endColumn; ++column) body(column, row);
}

void drawFace(const DrawList& list, const Face& face, std::span<const std::uint32_t> skipped, ItemBuffer& buffer) {
  std::vector<ScreenTriangle> triangles;
  for (const Draw& draw : list.draws)
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; i += 3)
      if (!std::binary_search(skipped.begin(), skipped.end(), i / 3)) append(triangles, list, draw, i, face);
  buffer.resize(face.scissor);
  std::fill(buffer.ids.begin(), buffer.ids.end(), backgroundId(list.format));
  std::vector<Visible> depthBuffer(buffer.ids.size());
  for (const ScreenTriangle& triangle : triangles)
    forEachPixel(triangle, face.scissor, [&](int column, int row) {
      const SnappedPoint sample = sampleOf(column, row);
      const Weights weights = weightsAt(triangle, sample);
      if (!covers(triangle, weights)) return;
      const std::size_t pixel =
          static_cast<std::size_t>(row - face.scissor.row) * static_cast<std::size_t>(buffer.width) +
          static_cast<std::size_t>(column - face.scissor.column);
      const double inverse = inverseDepth<double>(triangle, weights);
      if (!isNearer(triangle, weights, sample, inverse, depthBuffer[pixel])) return;
      depthBuffer[pixel] = {&triangle, inverse};
      buffer.ids[pixel] = itemId(list, triangle, weights);
    });
}

}  // namespace

PlainRenderer::PlainRenderer(DrawList list) : list_(std::move(list)) { validate(list_); }

void PlainRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                         std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  buffers.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    validate(faces[f]);
    drawFace(list_, faces[f], skipped, buffers[f]);
    drawn(f);
  }
}

}  // namespace hemitex::raster
