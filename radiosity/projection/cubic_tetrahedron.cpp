#include "radiosity/projection/cubic_tetrahedron.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "radiosity/projection/delta_form_factors.h"

namespace hemitex::radiosity {
namespace {

/// The farthest corner of a face's triangle is (1, -2) at distance 1.
constexpr double squaredReach = 1 + 1 + 4;

double pixelWidth(int resolution) { return 6.0 / (2 * resolution + 1); }

/// cos(theta) / pi per area of a face; a and b count from its corner along the common edges. At (x, y, 1) = (1 - a, 1 -
/// b, 1) let s be the distance. Then cos(theta) is (x + y + 1) / (sqrt(3) s), the foreshortening is 1/s, and solid
/// angle falls with 1/s^2.
double density(double a, double b) {
  const double x = 1 - a, y = 1 - b;
  const double s2 = x * x + y * y + 1;
  return (x + y + 1) / (std::sqrt(3.0) * pi * s2 * s2);
}

/// The integral over the area that a pixel at the horizon represents.
double horizonIntegral(const PixelGrid& grid, int a, int b) {
  const double pixel = grid.parts * grid.width;
  const auto triangle = [pixel](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    return triangleIntegral(pixel * p, pixel * q, pixel * r, density);
  };
  const glm::dvec2 low(a, b), half(0.5, 0), up(0, 0.5);
  const glm::dvec2 high = low + glm::dvec2(1), right = low + glm::dvec2(1, 0), top = low + glm::dvec2(0, 1);
  const double below = triangle(high, high - half, high - up);
  // The corner of the next pixel beyond the side: half of it, or all of it at a common edge of two faces.
  const double beside = triangle(right, right + up, b == 0 ? right + half : right + (half + up) / 2.0);
  const double above = triangle(top, top + half, a == 0 ? top + up : top + (half + up) / 2.0);
  return pixelIntegral(grid, a, b, density) - below + beside + above;
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
          .push_back(
              toShare(a + b == resolution - 1 ? horizonIntegral(grid, a, b) : pixelIntegral(grid, a, b, density)));
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

}  // namespace

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
  return {cubicTetrahedronFaces(resolution), {runningSums(first), runningSums(others)}, wholeShare, squaredReach};
}

}  // namespace hemitex::radiosity
