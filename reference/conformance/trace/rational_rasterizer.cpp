#include "reference/conformance/trace/rational_rasterizer.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>

#include "raster/base/parallel.h"
#include "raster/interface/assembly.h"

namespace hemitex::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Integer = boost::multiprecision::cpp_int;

/// x, y, w, u, v, z of a vertex, in binary64.
using Attributes = std::array<double, 6>;
enum Attribute : std::size_t { X, Y, W, U, V, Z };

/// The vertex stage.
Attributes vertexStage(const raster::Face& face, const raster::DrawList& list, std::uint32_t index,
                       const raster::Instance* instance) {
  const bool isScene = list.clipDepth == raster::ClipDepth::None;
  glm::vec3 position = list.positions[index];
  float z = isScene ? 0 : list.clipZ[index];
  if (instance) {
    const auto placed = [&](float value, int axis) { return value * instance->scale[axis] + instance->offset[axis]; };
    position = {placed(position.x, 0), placed(position.y, 1), placed(position.z, isScene ? 2 : 3)};
    z = isScene ? 0 : placed(z, 2);
  }
  const glm::vec3 d = position - face.eye;
  const auto product = [&](const glm::vec3& row) { return (row.x * d.x + row.y * d.y) + row.z * d.z; };
  const glm::vec2 texcoord = list.texcoords[index];
  return {product(face.x), product(face.y), product(face.w), texcoord.x, texcoord.y, z};
}

/// The half-spaces f >= n of all lists: f is the product of x, y, w and z with these numbers.
struct HalfSpace {
  double x, y, w, z, n;
};

/// w >= n, then in clip space those of z, then |x| <= 8w and |y| <= 8w.
std::vector<HalfSpace> halfSpaces(raster::ClipDepth depth, double n) {
  std::vector<HalfSpace> result{{0, 0, 1, 0, n}};
  if (depth == raster::ClipDepth::ZeroToOne) result.push_back({0, 0, 0, 1, 0});
  if (depth == raster::ClipDepth::MinusOneToOne) result.push_back({0, 0, 1, 1, 0});
  if (depth != raster::ClipDepth::None) result.push_back({0, 0, 1, -1, 0});
  result.insert(result.end(), {{-1, 0, 8, 0, 0}, {1, 0, 8, 0, 0}, {0, -1, 8, 0, 0}, {0, 1, 8, 0, 0}});
  return result;
}

std::vector<Attributes> clip(std::vector<Attributes> polygon, raster::ClipDepth depth, double n) {
  for (const HalfSpace& side : halfSpaces(depth, n)) {
    // At most two terms are not zero, so that the sum is rounded once.
    const auto f = [&](const Attributes& p) {
      return (side.w * p[W] + side.z * p[Z]) + (side.x * p[X] + side.y * p[Y]) - side.n;
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
      p[W] = side.n == n ? n : std::max(p[W], n);
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
  raster::ItemId offset;  ///< of the draw or its instance
  std::array<Attributes, 3> vertices;
  std::array<Point, 3> snapped;
  std::int64_t area;  ///< doubled, signed
  bool isBack;
  bool hasHoles;         ///< in its index map
  raster::ItemId value;  ///< of its front, without a texel
};

/// What the depths of a face depend on.
struct DepthRule {
  raster::ClipDepth space;
  raster::DepthPrecision precision;
  float n;
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
  if (list.value != raster::PixelValue::ItemIds || !draw.indexMap) return triangle.value;
  return blend(list, triangle.offset, fetch(list, triangle, sample));
}

/// The whole number next to a number of at least 0, the even one of two.
Integer nearestInteger(const Rational& value) {
  const Integer down = numerator(value) / denominator(value);
  const Rational rest = value - Rational(down);
  const bool isUp = 2 * rest > 1 || (2 * rest == 1 && down % 2 != 0);
  return isUp ? Integer(down + 1) : down;
}

/// A depth from 0 to 1 in binary32.
Rational inBinary32(const Rational& depth) {
  for (int exponent = 1; exponent <= 126; ++exponent) {
    const Rational unit(Integer(1), Integer(1) << (exponent + 23));
    if (depth >= unit * (1 << 23) || exponent == 126) return Rational(nearestInteger(depth / unit)) * unit;
  }
  return depth;
}

/// The depth of a fragment, as it is stored: smaller for nearer ones.
Rational depthAt(const DepthRule& rule, const Triangle& triangle, const Point& sample) {
  const std::array<Rational, 3> weights = weightsOverDepth(triangle, sample);
  Rational depth;  // z/w
  for (std::size_t k = 0; k < 3; ++k) depth += weights[k] * Rational(triangle.vertices[k][Z]);
  if (rule.space == raster::ClipDepth::None) depth = 1 - Rational(rule.n) * sum(weights);
  if (rule.space == raster::ClipDepth::MinusOneToOne) depth = (depth + 1) / 2;
  if (rule.precision == raster::DepthPrecision::Exact) return depth;
  depth = std::clamp(depth, Rational(0), Rational(1));
  if (rule.precision == raster::DepthPrecision::Float32) return inBinary32(depth);
  const int steps = rule.precision == raster::DepthPrecision::Unorm16 ? 65535 : 16777215;
  return Rational(nearestInteger(depth * steps));
}

bool passes(raster::DepthTest test, const Rational& incoming, const Rational& stored) {
  if (test == raster::DepthTest::Nearer) return incoming < stored;
  if (test == raster::DepthTest::NearerOrEqual) return incoming <= stored;
  return test == raster::DepthTest::Farther ? incoming > stored : incoming >= stored;
}

/// The item ID of the triangle that a sample shows.
raster::ItemId idAt(const raster::DrawList& list, const DepthRule& rule, const std::vector<Triangle>& triangles,
                    const Point& sample) {
  const Triangle* shown = nullptr;
  raster::ItemId passed = 0;
  std::optional<Rational> stored;  // the depth, known once two triangles compete
  for (const Triangle& triangle : triangles) {
    if (!isCovered(triangle, sample)) continue;
    if (triangle.hasHoles && fetch(list, triangle, sample) == 0xFFFFFFFF) continue;
    if (shown != nullptr) {
      if (!stored) stored = depthAt(rule, *shown, sample);
      const Rational depth = depthAt(rule, triangle, sample);
      if (!passes(list.depthTest, depth, *stored)) continue;
      stored = depth;
    }
    shown = &triangle;
    ++passed;
  }
  if (list.value == raster::PixelValue::PassedSamples) return passed;
  return shown ? idAt(list, *shown, sample) : raster::backgroundId(list.format);
}

bool isFinite(const Attributes& p) {
  return std::all_of(p.begin(), p.end(), [](double value) { return std::isfinite(value); });
}

bool drawCulls(const raster::Draw& draw, bool isBack) {
  return isBack ? draw.cull == raster::Cull::Back : draw.cull == raster::Cull::Front;
}

/// The triangles of a draw, as vertices; counted entry by entry.
std::vector<std::array<std::uint32_t, 3>> assemble(const raster::DrawList& list, const raster::Draw& draw) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint32_t start = draw.first;  // of the entries since the last restart
  for (std::uint32_t k = draw.first; k < draw.first + draw.count; ++k) {
    const auto vertex = [&](std::uint32_t entry) { return list.indices[entry] + draw.baseVertex; };
    if (draw.restarts && list.indices[k] == (list.indexBits == 16 ? 65535 : 4294967295)) start = k + 1;
    const std::uint32_t entries = k + 1 - start;
    const bool isList = draw.topology == raster::Topology::Triangles;
    if (entries < 3 || (isList && entries % 3 != 0)) continue;
    std::array<std::uint32_t, 3> corners{vertex(k - 2), vertex(k - 1), vertex(k)};
    const bool isFirst = list.provoking == raster::Provoking::First;
    if (draw.topology == raster::Topology::Fan) corners[0] = vertex(start);
    if (draw.topology == raster::Topology::Fan && isFirst)
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    // Every other triangle of a strip winds the other way; the provoking vertex stays in its place.
    const bool isOdd = draw.topology == raster::Topology::Strip && entries % 2 == 0;
    if (isOdd) std::swap(corners[isFirst ? 2 : 0], corners[1]);
    triangles.push_back(corners);
  }
  return triangles;
}

/// The value of a front without texels.
raster::ItemId valueOf(const raster::DrawList& list, raster::ItemId offset, std::uint32_t number,
                       const std::array<std::uint32_t, 3>& corners) {
  switch (list.value) {
    case raster::PixelValue::TriangleNumbers:
      return offset + number;
    case raster::PixelValue::VertexValues:
      return offset + list.vertexValues[list.provoking == raster::Provoking::First ? corners[0] : corners[2]];
    case raster::PixelValue::Pairs:
      return raster::PairNumbers(list).numberOf(std::uint64_t{offset} << 32 | number);
    default:
      return offset;
  }
}

/// Appends what clipping, snapping and culling leave of a triangle. `triangle` has all that does not depend on them.
void append(const raster::DrawList& list, const raster::Face& face, const std::vector<Attributes>& corners,
            Triangle triangle, std::vector<Triangle>& triangles) {
  if (!std::all_of(corners.begin(), corners.end(), isFinite)) return;
  const std::vector<Attributes> polygon = clip(corners, list.clipDepth, face.nearDistance);
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    triangle.vertices = {polygon[0], polygon[k - 1], polygon[k]};
    for (std::size_t c = 0; c < 3; ++c) triangle.snapped[c] = snap(triangle.vertices[c], raster::viewportOf(face));
    triangle.area = cross(triangle.snapped[1] - triangle.snapped[0], triangle.snapped[2] - triangle.snapped[0]);
    const bool isClockwise = sign(triangle.area) == (raster::determinant(face) > 0 ? 1 : -1);
    triangle.isBack = isClockwise == (list.front == raster::Winding::CounterClockwise);
    if (triangle.area != 0 && !drawCulls(*triangle.draw, triangle.isBack)) triangles.push_back(triangle);
  }
}

/// The triangles of all draws and their instances, in draw order.
std::vector<Triangle> trianglesOf(const raster::DrawList& list, const raster::Face& face,
                                  std::span<const std::uint32_t> skipped) {
  std::vector<Triangle> triangles;
  std::uint32_t count = 0;  // of all triangles so far
  for (const raster::Draw& draw : list.draws) {
    const bool hasHoles = draw.indexMap && raster::hasHoles(list.indexMaps[static_cast<std::size_t>(*draw.indexMap)]);
    const std::vector<std::array<std::uint32_t, 3>> assembly = assemble(list, draw);
    for (std::uint32_t i = 0; i < std::max(draw.instances, 1U); ++i) {
      const raster::Instance* instance = draw.instances == 0 ? nullptr : &list.instances[draw.firstInstance + i];
      const raster::ItemId offset = draw.offset + (instance ? instance->id : 0);
      for (std::uint32_t t = 0; t < assembly.size(); ++t) {
        if (std::find(skipped.begin(), skipped.end(), count++) != skipped.end()) continue;
        std::vector<Attributes> corners;
        for (const std::uint32_t vertex : assembly[t]) corners.push_back(vertexStage(face, list, vertex, instance));
        append(list, face, corners, {&draw, offset, {}, {}, 0, false, hasHoles, valueOf(list, offset, t, assembly[t])},
               triangles);
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
  const DepthRule rule{list.clipDepth, list.depthPrecision, face.nearDistance};
  const std::int64_t middle = face.sample == raster::SamplePlace::Middle ? 128 : 0;
  raster::parallelFor(static_cast<std::size_t>(buffer.height), [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      const Point pixel(face.scissor.column + static_cast<int>(column), face.scissor.row + static_cast<int>(row));
      buffer.ids[row * width + column] = idAt(list, rule, triangles, std::int64_t{256} * pixel + middle);
    }
  });
  return buffer;
}

}  // namespace hemitex::reference
