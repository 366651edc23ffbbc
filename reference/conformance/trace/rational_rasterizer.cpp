#include "reference/conformance/trace/rational_rasterizer.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>

#include "raster/base/parallel.h"

namespace hemitex::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Integer = boost::multiprecision::cpp_int;

/// x, y, w, u, v of a vertex, in binary64.
using Attributes = std::array<double, 5>;
enum Attribute : std::size_t { X, Y, W, U, V };

/// The vertex stage.
Attributes vertexStage(const raster::Face& face, const glm::vec3& position, const glm::vec2& texcoord) {
  const glm::vec3 d = position - face.eye;
  const auto product = [&](const glm::vec3& row) { return (row.x * d.x + row.y * d.y) + row.z * d.z; };
  return {product(face.x), product(face.y), product(face.w), texcoord.x, texcoord.y};
}

/// Clips to w >= n, then to |x| <= 8w and |y| <= 8w.
std::vector<Attributes> clip(std::vector<Attributes> polygon, double n) {
  for (const int plane : {0, 1, 2, 3, 4}) {
    const auto f = [&](const Attributes& p) {
      const double side = p[plane < 3 ? X : Y];
      return plane == 0 ? p[W] - n : plane % 2 == 1 ? 8 * p[W] - side : 8 * p[W] + side;
    };
    std::vector<Attributes> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Attributes& start = polygon[i];
      const Attributes& end = polygon[(i + 1) % polygon.size()];
      if (f(start) >= 0) result.push_back(start);
      if ((f(start) >= 0) == (f(end) >= 0)) continue;
      const Attributes& a = f(start) >= 0 ? start : end;
      const Attributes& b = f(start) >= 0 ? end : start;
      const double t = f(a) / (f(a) - f(b));
      Attributes p;
      for (std::size_t k = 0; k < p.size(); ++k) p[k] = a[k] + t * (b[k] - a[k]);
      p[W] = plane == 0 ? n : std::max(p[W], n);
      result.push_back(p);
    }
    polygon = result;
  }
  return polygon;
}

/// A point or a direction of the picture, in units of 1/256 pixel.
using Point = glm::i64vec2;

/// The snapped position.
Point snap(const Attributes& p, const raster::Viewport& viewport) {
  const auto coordinate = [&](double q, int pixels) {
    return static_cast<std::int64_t>(std::nearbyint((std::clamp(q, -8.0, 8.0) + 1) * (128.0 * pixels)));
  };
  return {coordinate(p[X] / p[W], viewport.columns), coordinate(p[Y] / p[W], viewport.rows)};
}

std::int64_t cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
int sign(std::int64_t value) { return (value > 0) - (value < 0); }

struct Triangle {
  const raster::Draw* draw;
  std::array<Attributes, 3> vertices;
  std::array<Point, 3> snapped;
  std::int64_t area;  ///< doubled, signed
  bool isBack;
  bool hasHoles;          ///< in its index map
  raster::ItemId number;  ///< in its draw
};

/// The sign of the area that `sample`, moved by (epsilon, epsilon^2), spans with the edge from a to b.
int side(const Point& a, const Point& b, const Point& sample) {
  const Point edge = b - a;
  if (const int s = sign(cross(edge, sample - a)); s != 0) return s;
  if (const int s = sign(cross(edge, {1, 0})); s != 0) return s;
  return sign(cross(edge, {0, 1}));
}

bool isCovered(const Triangle& triangle, const Point& sample) {
  const std::array<Point, 3>& s = triangle.snapped;
  const int orientation = sign(triangle.area);
  return side(s[0], s[1], sample) == orientation && side(s[1], s[2], sample) == orientation &&
         side(s[2], s[0], sample) == orientation;
}

/// b_k / w_k at the sample.
std::array<Rational, 3> weightsOverDepth(const Triangle& triangle, const Point& sample) {
  std::array<Rational, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& a = triangle.snapped[(k + 1) % 3];
    const Point& b = triangle.snapped[(k + 2) % 3];
    weights[k] = Rational(cross(b - a, sample - a)) / Rational(triangle.area) / Rational(triangle.vertices[k][W]);
  }
  return weights;
}

Rational sum(const std::array<Rational, 3>& values) { return values[0] + values[1] + values[2]; }

int texel(const Triangle& triangle, const std::array<Rational, 3>& weights, Attribute attribute, int size) {
  Rational position;
  for (std::size_t k = 0; k < 3; ++k) position += weights[k] * Rational(triangle.vertices[k][attribute]);
  position = position / sum(weights) * size;
  if (position < 0) return 0;
  const Integer whole = numerator(position) / denominator(position);
  return whole >= size ? size - 1 : whole.convert_to<int>();
}

raster::ItemId blend(const raster::DrawList& list, raster::ItemId offset, raster::ItemId texelId) {
  if (list.blend == raster::Blend::Replace) return texelId;
  if (list.blend == raster::Blend::IntegerAdd) {
    int bits = 0;
    for (const int channel : list.format.channelBits) bits += channel;
    return static_cast<raster::ItemId>((std::uint64_t{offset} + texelId) % (std::uint64_t{1} << bits));
  }
  raster::ItemId result = 0;
  std::uint64_t unit = 1;
  for (const int bits : list.format.channelBits) {
    const std::uint64_t values = std::uint64_t{1} << bits;
    const std::uint64_t channel = std::min(offset / unit % values + texelId / unit % values, values - 1);
    result += static_cast<raster::ItemId>(channel * unit);
    unit *= values;
  }
  return result;
}

/// The value of the index map of a triangle that has one.
raster::ItemId fetch(const raster::DrawList& list, const Triangle& triangle, const Point& sample) {
  const raster::IndexMap& map = list.indexMaps[static_cast<std::size_t>(*triangle.draw->indexMap)];
  const std::array<Rational, 3> weights = weightsOverDepth(triangle, sample);
  const int column = texel(triangle, weights, U, map.width);
  const int row = texel(triangle, weights, V, map.height);
  return map.ids[static_cast<std::size_t>(row * map.width + column)];
}

raster::ItemId idAt(const raster::DrawList& list, const Triangle& triangle, const Point& sample) {
  const raster::Draw& draw = *triangle.draw;
  if (triangle.isBack && draw.back) return *draw.back;
  if (list.value == raster::PixelValue::TriangleNumbers) return draw.offset + triangle.number;
  if (!draw.indexMap) return draw.offset;
  return blend(list, draw.offset, fetch(list, triangle, sample));
}

/// The depth test of two values of 1/w.
bool passes(raster::DepthTest test, const Rational& incoming, const Rational& stored) {
  if (test == raster::DepthTest::Nearer) return incoming > stored;
  if (test == raster::DepthTest::NearerOrEqual) return incoming >= stored;
  return test == raster::DepthTest::Farther ? incoming < stored : incoming <= stored;
}

/// The item ID of the triangle that a sample shows.
raster::ItemId idAt(const raster::DrawList& list, const std::vector<Triangle>& triangles, const Point& sample) {
  const Triangle* shown = nullptr;
  std::optional<Rational> stored;  // 1/w, known once two triangles compete
  for (const Triangle& triangle : triangles) {
    if (!isCovered(triangle, sample)) continue;
    if (triangle.hasHoles && fetch(list, triangle, sample) == 0xFFFFFFFF) continue;
    if (shown != nullptr) {
      if (!stored) stored = sum(weightsOverDepth(*shown, sample));
      const Rational inverseDepth = sum(weightsOverDepth(triangle, sample));
      if (!passes(list.depthTest, inverseDepth, *stored)) continue;
      stored = inverseDepth;
    }
    shown = &triangle;
  }
  return shown ? idAt(list, *shown, sample) : raster::backgroundId(list.format);
}

bool isFinite(const Attributes& p) {
  return std::all_of(p.begin(), p.end(), [](double value) { return std::isfinite(value); });
}

bool isCulled(const raster::Draw& draw, bool isBack) {
  return isBack ? draw.cull == raster::Cull::Back : draw.cull == raster::Cull::Front;
}

/// The triangles of all draws after clipping, snapping and culling, in draw order.
std::vector<Triangle> trianglesOf(const raster::DrawList& list, const raster::Face& face,
                                  std::span<const std::uint32_t> skipped) {
  std::vector<Triangle> triangles;
  for (const raster::Draw& draw : list.draws) {
    const bool hasHoles = draw.indexMap && raster::hasHoles(list.indexMaps[static_cast<std::size_t>(*draw.indexMap)]);
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
      if (std::find(skipped.begin(), skipped.end(), first / 3) != skipped.end()) continue;
      std::vector<Attributes> polygon;
      for (std::uint32_t k = first; k < first + 3; ++k)
        polygon.push_back(vertexStage(face, list.positions[list.indices[k]], list.texcoords[list.indices[k]]));
      if (!std::all_of(polygon.begin(), polygon.end(), isFinite)) continue;
      polygon = clip(polygon, face.nearDistance);
      for (std::size_t k = 2; k < polygon.size(); ++k) {
        Triangle triangle{
            &draw, {polygon[0], polygon[k - 1], polygon[k]}, {}, 0, false, hasHoles, (first - draw.first) / 3};
        for (std::size_t c = 0; c < 3; ++c) triangle.snapped[c] = snap(triangle.vertices[c], raster::viewportOf(face));
        triangle.area = cross(triangle.snapped[1] - triangle.snapped[0], triangle.snapped[2] - triangle.snapped[0]);
        triangle.isBack = sign(triangle.area) == (raster::determinant(face) > 0 ? 1 : -1);
        if (triangle.area != 0 && !isCulled(draw, triangle.isBack)) triangles.push_back(triangle);
      }
    }
  }
  return triangles;
}

}  // namespace

raster::ItemBuffer evaluateRules(const raster::DrawList& list, const raster::Face& face,
                                 std::span<const std::uint32_t> skipped) {
  raster::validate(list);
  raster::validate(face);
  const std::vector<Triangle> triangles = trianglesOf(list, face, skipped);
  raster::ItemBuffer buffer;
  buffer.resize(face.scissor);
  const auto width = static_cast<std::size_t>(buffer.width);
  const std::int64_t middle = face.sample == raster::SamplePlace::Middle ? 128 : 0;
  raster::parallelFor(static_cast<std::size_t>(buffer.height), [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      const Point pixel(face.scissor.column + static_cast<int>(column), face.scissor.row + static_cast<int>(row));
      buffer.ids[row * width + column] = idAt(list, triangles, std::int64_t{256} * pixel + middle);
    }
  });
  return buffer;
}

}  // namespace hemitex::reference
