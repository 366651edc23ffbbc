#include "radiosity/projection/projection_kinds.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

using std::numbers::pi;

/// Gauss-Legendre nodes and weights on [0, 1].
template <std::size_t points>
struct GaussRule {
  std::array<double, points> node, weight;
};

const GaussRule<4>& gaussRule() {
  static const GaussRule<4> rule = [] {
    const double root = std::sqrt(6.0 / 5.0);
    const double inner = std::sqrt((3 - 2 * root) / 7), outer = std::sqrt((3 + 2 * root) / 7);
    const double innerWeight = (18 + std::sqrt(30.0)) / 72, outerWeight = (18 - std::sqrt(30.0)) / 72;
    return GaussRule<4>{{(1 - outer) / 2, (1 - inner) / 2, (1 + inner) / 2, (1 + outer) / 2},
                        {outerWeight, innerWeight, innerWeight, outerWeight}};
  }();
  return rule;
}

/// Wider pixels are divided into parts. The densities of projections vary over lengths of 1 and more, so that four by
/// four points on such a part reach rounding accuracy.
constexpr double widestPart = 1.0 / 16;

/// The form factor in units of 2^-60, rounded to nearest.
std::uint64_t toShare(double formFactor) {
  return static_cast<std::uint64_t>(std::nearbyint(std::ldexp(formFactor, shareBits)));
}

/// Pixels that divide [0, extent], and the parts of each pixel.
struct PixelGrid {
  int parts;     ///< along the side of a pixel
  double width;  ///< of a part

  PixelGrid(int pixels, double extent)
      : parts(static_cast<int>(std::ceil(extent / widestPart / pixels))), width(extent / (pixels * parts)) {}
};

/// The integral over a pixel.
template <std::size_t points = 4, typename Density>
double pixelIntegral(const PixelGrid& grid, int column, int row, const Density& density,
                     const GaussRule<points>& rule = gaussRule()) {
  double sum = 0;
  for (int part = 0; part < grid.parts * grid.parts; ++part)
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t j = 0; j < points; ++j) {
        const double x = (column * grid.parts + part % grid.parts + rule.node[i]) * grid.width;
        const double y = (row * grid.parts + part / grid.parts + rule.node[j]) * grid.width;
        sum += rule.weight[i] * rule.weight[j] * density(x, y);
      }
  return sum * grid.width * grid.width;
}

/// The integral over a triangle.
template <typename Density>
double triangleIntegral(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const Density& density) {
  const glm::dvec2 ab = b - a, bc = c - b;
  if (glm::length(ab) > widestPart || glm::length(bc) > widestPart) {
    const glm::dvec2 p = (a + b) / 2.0, q = (b + c) / 2.0, r = (c + a) / 2.0;
    return triangleIntegral(a, p, r, density) + triangleIntegral(p, b, q, density) +
           triangleIntegral(r, q, c, density) + triangleIntegral(q, r, p, density);
  }
  // Points a + s (ab + t bc) with s and t from 0 to 1 fill the triangle with a density of s times its doubled area.
  const GaussRule<4>& rule = gaussRule();
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const glm::dvec2 point = a + rule.node[i] * (ab + rule.node[j] * bc);
      sum += rule.weight[i] * rule.weight[j] * rule.node[i] * density(point.x, point.y);
    }
  return sum * std::abs(ab.x * bc.y - ab.y * bc.x);
}

/// The shares of the pixels x pixels squares of [0, extent]^2, row-major.
template <typename Density>
std::vector<std::uint64_t> pixelShares(int pixels, double extent, const Density& density) {
  const PixelGrid grid(pixels, extent);
  std::vector<std::uint64_t> shares;
  shares.reserve(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels));
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column)
      shares.push_back(toShare(pixelIntegral(grid, column, row, density)));
  return shares;
}

/// A square table of four mirrored quadrants, from the quadrant at its end, row-major from the middle outwards.
std::vector<std::uint64_t> mirroredQuadrant(const std::vector<std::uint64_t>& quadrant, int half) {
  const auto fromMiddle = [half](int i) { return static_cast<std::size_t>(i < half ? half - 1 - i : i - half); };
  std::vector<std::uint64_t> table;
  table.reserve(4 * quadrant.size());
  for (int row = 0; row < 2 * half; ++row)
    for (int column = 0; column < 2 * half; ++column)
      table.push_back(quadrant[fromMiddle(row) * static_cast<std::size_t>(half) + fromMiddle(column)]);
  return table;
}

/// Adds `missing` units evenly to the shares; the first shares receive the remainder, one unit each.
void spread(std::vector<std::uint64_t>& shares, std::int64_t missing) {
  const auto count = static_cast<std::int64_t>(shares.size());
  const std::int64_t remainder = (missing % count + count) % count;
  const std::int64_t each = (missing - remainder) / count;
  for (std::int64_t i = 0; i < count; ++i)
    shares[static_cast<std::size_t>(i)] += static_cast<std::uint64_t>(each + (i < remainder ? 1 : 0));
}

/// Projection::sharesBefore of the shares of pixels.
std::vector<std::uint64_t> runningSums(const std::vector<std::uint64_t>& shares) {
  std::vector<std::uint64_t> before(shares.size() + 1);
  std::partial_sum(shares.begin(), shares.end(), before.begin() + 1);
  return before;
}

// cos(theta) / pi per area of a plane at distance 1 and of a side of a hemicube (Cohen and Greenberg 1985). With s the
// distance to the point, cos(theta) is 1/s on the plane and z/s on a side. The foreshortening is 1/s, and solid angle
// falls with 1/s^2.
double planeDensity(double x, double y) {
  const double s2 = x * x + y * y + 1;
  return 1 / (pi * s2 * s2);
}
double sideDensity(double x, double z) {
  const double s2 = x * x + z * z + 1;
  return z / (pi * s2 * s2);
}

/// The farthest corner of a face's triangle is (1, -2) at distance 1.
constexpr double tetrahedronSquaredReach = 1 + 1 + 4;

double pixelWidth(int resolution) { return 6.0 / (2 * resolution + 1); }

/// As planeDensity, for a face of the cubic tetrahedron; a and b count from its corner along the common edges. At (x,
/// y, 1) = (1 - a, 1 - b, 1) let s be the distance. Then cos(theta) is (x + y + 1) / (sqrt(3) s), the foreshortening is
/// 1/s, and solid angle falls with 1/s^2.
double leaningDensity(double a, double b) {
  const double x = 1 - a, y = 1 - b;
  const double s2 = x * x + y * y + 1;
  return (x + y + 1) / (std::sqrt(3.0) * pi * s2 * s2);
}

/// The integral over the area that a pixel at the horizon represents.
double horizonIntegral(const PixelGrid& grid, int a, int b) {
  const double pixel = grid.parts * grid.width;
  const auto triangle = [pixel](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    return triangleIntegral(pixel * p, pixel * q, pixel * r, leaningDensity);
  };
  const glm::dvec2 low(a, b), half(0.5, 0), up(0, 0.5);
  const glm::dvec2 high = low + glm::dvec2(1), right = low + glm::dvec2(1, 0), top = low + glm::dvec2(0, 1);
  const double below = triangle(high, high - half, high - up);
  // The corner of the next pixel beyond the side: half of it, or all of it at a common edge of two faces.
  const double beside = triangle(right, right + up, b == 0 ? right + half : right + (half + up) / 2.0);
  const double above = triangle(top, top + half, a == 0 ? top + up : top + (half + up) / 2.0);
  return pixelIntegral(grid, a, b, leaningDensity) - below + beside + above;
}

/// The shares of a face by (a, b), only for a < b and a = b; those across the diagonal are equal.
struct HalfFace {
  std::vector<std::uint64_t> beside, diagonal;
};

HalfFace halfFace(int resolution) {
  const PixelGrid grid(resolution, resolution * pixelWidth(resolution));
  HalfFace half;
  for (int a = 0; 2 * a < resolution; ++a)
    for (int b = a; a + b < resolution; ++b)
      (a == b ? half.diagonal : half.beside)
          .push_back(toShare(a + b == resolution - 1 ? horizonIntegral(grid, a, b)
                                                     : pixelIntegral(grid, a, b, leaningDensity)));
  return half;
}

/// Makes a face sum to a third of the largest multiple of three.
void closeSum(HalfFace& half) {
  std::uint64_t sum = 0;
  for (const std::uint64_t share : half.beside) sum += 2 * share;
  for (const std::uint64_t share : half.diagonal) sum += share;
  const auto missing = static_cast<std::int64_t>(wholeShare / 3 - sum);
  const std::int64_t odd = missing & 1;
  half.diagonal.front() += static_cast<std::uint64_t>(odd);
  spread(half.beside, (missing - odd) / 2);
}

/// Row-major by column and row, which grow towards the corner.
std::vector<std::uint64_t> wholeFace(const HalfFace& half, int resolution) {
  const auto side = static_cast<std::size_t>(resolution);
  std::vector<std::uint64_t> shares(side * side, 0);
  auto beside = half.beside.begin(), diagonal = half.diagonal.begin();
  const auto at = [&](std::size_t a, std::size_t b) -> std::uint64_t& {
    return shares[(side - 1 - b) * side + (side - 1 - a)];
  };
  for (std::size_t a = 0; 2 * a < side; ++a)
    for (std::size_t b = a; a + b < side; ++b) at(a, b) = at(b, a) = a == b ? *diagonal++ : *beside++;
  return shares;
}

/// One face along +z, `halfWidth` wide to each side at distance 1.
std::vector<ProjectionFace> planeFace(int resolution, double halfWidth) {
  return {{{1 / halfWidth, 0, 0}, {0, 1 / halfWidth, 0}, {0, 0, 1}, resolution, {0, 0, resolution, resolution}, 0}};
}

/// All faces of a cube around a point: those of a hemicube, its sides in full, and the bottom.
std::vector<ProjectionFace> cubeFaces(int resolution) {
  std::vector<ProjectionFace> faces = hemicubeFaces(resolution);
  const ProjectionFace& top = faces.front();
  faces.push_back({top.y, top.x, -top.w, resolution, top.scissor, 0});
  for (ProjectionFace& face : faces) face.scissor = top.scissor;
  return faces;
}

/// The shares of a lamp through the pixels of a face, as real numbers, row-major. Per area of the plane at distance 1,
/// solid angle is 1/s^3 with s the distance. Faces of lamps have many pixels, for which two by two points are enough.
std::vector<double> lampShares(const ProjectionFace& face, double halfWidth, const std::optional<LampCone>& cone) {
  const auto side = static_cast<std::size_t>(face.resolution);
  const PixelGrid grid(face.resolution, 2 * halfWidth);
  const glm::dvec3 right = halfWidth * face.x, up = halfWidth * face.y;
  const double whole = fullSolidAngle(cone);
  const auto density = [&](double x, double y) {
    const glm::dvec3 direction = (x - halfWidth) * right + (y - halfWidth) * up + face.w;
    const double s2 = glm::dot(direction, direction), s = std::sqrt(s2);
    return (cone ? intensityAt(*cone, glm::dot(direction, cone->axis) / s) : 1) / (s2 * s * whole);
  };
  const double apart = std::sqrt(1.0 / 12);
  const GaussRule<2> two{{0.5 - apart, 0.5 + apart}, {0.5, 0.5}};
  const bool isFine = grid.parts * grid.width < widestPart / 4;
  std::vector<double> shares(side * side);
  raster::parallelFor(side, [&](std::size_t row) {
    for (std::size_t column = 0; column < side; ++column) {
      const int c = static_cast<int>(column), r = static_cast<int>(row);
      shares[row * side + column] =
          isFine ? pixelIntegral(grid, c, r, density, two) : pixelIntegral(grid, c, r, density);
    }
  });
  return shares;
}

}  // namespace

std::vector<ProjectionFace> hemicubeFaces(int resolution) {
  assert(resolution >= 2 && resolution <= 4096 && resolution % 2 == 0);
  const raster::Scissor whole{0, 0, resolution, resolution};
  const raster::Scissor aboveHorizon{0, resolution / 2, resolution, resolution / 2};
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), normal(0, 0, 1);
  return {{x, y, normal, resolution, whole, 0},
          {y, normal, x, resolution, aboveHorizon, 1},
          {-x, normal, y, resolution, aboveHorizon, 1},
          {-y, normal, -x, resolution, aboveHorizon, 1},
          {x, normal, -y, resolution, aboveHorizon, 1}};
}

Projection hemicube(int resolution) {
  const int half = resolution / 2;
  std::vector<std::uint64_t> quadrant = pixelShares(half, 1, planeDensity);
  const std::vector<std::uint64_t> halfSide = pixelShares(half, 1, sideDensity);
  // The rounding error of the sum: four quadrants of the top and eight halves of sides.
  const std::uint64_t sum = std::accumulate(quadrant.begin(), quadrant.end(), std::uint64_t{0}) +
                            2 * std::accumulate(halfSide.begin(), halfSide.end(), std::uint64_t{0});
  spread(quadrant, static_cast<std::int64_t>(wholeShare / 4 - sum));
  // By symmetry these are enough: a side is the second half of a square, from the horizon on.
  std::vector<std::uint64_t> side = mirroredQuadrant(halfSide, half);
  side.erase(side.begin(), side.begin() + static_cast<std::ptrdiff_t>(side.size() / 2));
  return {hemicubeFaces(resolution),
          {runningSums(mirroredQuadrant(quadrant, half)), runningSums(side)},
          wholeShare,
          hemicubeSquaredReach};
}

Projection singlePlane(int resolution, double halfWidth) {
  assert(resolution >= 2 && resolution <= 4096 && resolution % 2 == 0);
  assert(halfWidth > 0 && halfWidth <= 64);
  const int half = resolution / 2;
  const std::vector<std::uint64_t> quadrant = pixelShares(half, halfWidth, planeDensity);
  const std::uint64_t captured = 4 * std::accumulate(quadrant.begin(), quadrant.end(), std::uint64_t{0});
  return {planeFace(resolution, halfWidth),
          {runningSums(mirroredQuadrant(quadrant, half))},
          captured,
          1 + 2 * halfWidth * halfWidth};
}

std::vector<ProjectionFace> cubicTetrahedronFaces(int resolution) {
  assert(resolution >= 2 && resolution <= 4096 && resolution % 2 == 0);
  // The edges of the cube: orthogonal, each rotated by a third of a turn, at the same angle to the normal.
  const double height = std::sqrt(1.0 / 3), side = std::sqrt(1.0 / 2), back = std::sqrt(1.0 / 6);
  const std::array<glm::dvec3, 3> edge{
      {{0, std::sqrt(2.0 / 3), height}, {-side, -back, height}, {side, -back, height}}};
  // The view is `width` wide and ends at the common edges: x - 1 is -width at one side and 0 at the other.
  const double halfWidth = resolution * pixelWidth(resolution) / 2;
  std::vector<ProjectionFace> faces;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& w = edge[k];
    const auto row = [&](const glm::dvec3& along) { return (along + (halfWidth - 1) * w) / halfWidth; };
    faces.push_back({row(edge[(k + 1) % 3]),
                     row(edge[(k + 2) % 3]),
                     w,
                     resolution,
                     {0, 0, resolution, resolution},
                     k == 0 ? std::size_t{0} : std::size_t{1}});
  }
  return faces;
}

Projection cubicTetrahedron(int resolution) {
  HalfFace half = halfFace(resolution);
  closeSum(half);
  std::vector<std::uint64_t> others = wholeFace(half, resolution);
  std::vector<std::uint64_t> first = others;
  first.back() += wholeShare % 3;
  return {cubicTetrahedronFaces(resolution),
          {runningSums(first), runningSums(others)},
          wholeShare,
          tetrahedronSquaredReach};
}

double intensityAt(const LampCone& cone, double cosine) {
  const double ramp = std::clamp((cosine - cone.outerCosine) / (cone.innerCosine - cone.outerCosine), 0.0, 1.0);
  return ramp * ramp;
}

double fullSolidAngle(const std::optional<LampCone>& cone) {
  if (!cone) return 4 * pi;
  return 2 * pi * (1 - cone->innerCosine + (cone->innerCosine - cone->outerCosine) / 3);
}

Projection lampProjection(int resolution, const std::optional<LampCone>& cone, double halfWidth, bool holdsAll) {
  const bool isCube = halfWidth > widestLampFace;
  Projection projection;
  projection.faces = isCube ? cubeFaces(resolution) : planeFace(resolution, halfWidth);
  projection.squaredReach = isCube ? hemicubeSquaredReach : 1 + 2 * halfWidth * halfWidth;
  std::vector<std::vector<double>> shares;
  for (ProjectionFace& face : projection.faces) {
    if (shares.empty() || cone) shares.push_back(lampShares(face, isCube ? 1 : halfWidth, cone));
    face.shares = shares.size() - 1;
  }
  double sum = 0;
  for (const ProjectionFace& face : projection.faces)
    sum = std::accumulate(shares[face.shares].begin(), shares[face.shares].end(), sum);
  const double most = 1 - 0x1p-40, scale = holdsAll || sum > most ? most / sum : 1;
  for (const std::vector<double>& ofFace : shares) {
    std::vector<std::uint64_t> rounded;
    for (const double share : ofFace) rounded.push_back(toShare(scale * share));
    projection.sharesBefore.push_back(runningSums(rounded));
  }
  projection.captured = 0;
  for (const ProjectionFace& face : projection.faces)
    projection.captured += projection.sharesBefore[face.shares].back();
  return projection;
}

std::vector<std::pair<std::string, ProjectionKind>> namedProjections() {
  return {{"hemicube", ProjectionKind::Hemicube},
          {"single-plane", ProjectionKind::SinglePlane},
          {"tetrahedron", ProjectionKind::CubicTetrahedron}};
}

Projection projectionOf(ProjectionKind kind, int resolution) {
  switch (kind) {
    case ProjectionKind::SinglePlane:
      return singlePlane(resolution);
    case ProjectionKind::CubicTetrahedron:
      return cubicTetrahedron(resolution);
    default:
      return hemicube(resolution);
  }
}

}  // namespace hemitex::radiosity
