// texelAreas: exact areas of surfaces inside texels.
#include "radiosity/discretization/texel_areas.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/geometry/grid_clipping.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

double sumOf(const std::vector<double>& values) {
  long double sum = 0;
  for (const double value : values) sum += value;
  return static_cast<double>(sum);
}

}  // namespace

TEST_CASE("texelAreas sum to the surface's area, for all charts and grids", "[texels]") {
  const std::vector<std::array<int, 2>> grids{{1, 1}, {2, 3}, {16, 16}, {63, 65}, {1, 300}, {300, 1}, {256, 256}};
  for (const Surface& surface : tableOfSurfaces())
    for (const auto& [columns, rows] : grids) {
      INFO(surface.name << " " << columns << " x " << rows);
      CHECK(sumOf(texelAreas(surface, {columns, rows, {}}).area) == Approx(totalArea(surface)).epsilon(1e-12));
    }
}

TEST_CASE("texelAreas of a million texels sum to the surface's area", "[texels]") {
  for (const Surface& surface : {lShape(), bump(50), thinDiagonal(1e-6)})
    CHECK(sumOf(texelAreas(surface, {1024, 1024, {}}).area) == Approx(totalArea(surface)).epsilon(1e-12));
}

TEST_CASE("texelAreas of a parallelogram are equal, and its texels are completely covered", "[texels]") {
  // |(2,0,1) x (0,3,1)| = |(-3,-2,6)| = 7.
  const Surface surface = parallelogram("p", {5, 5, 5}, {2, 0, 1}, {0, 3, 1});
  const TexelAreas texels = texelAreas(surface, {24, 7, {}});
  for (std::size_t i = 0; i < texels.area.size(); ++i) {
    CHECK(texels.area[i] == Approx(7.0 / (24 * 7)).epsilon(1e-13));
    CHECK(texels.coverage[i] == Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("texelAreas of half a square cover the texels below its diagonal, and those on it by half", "[texels]") {
  const int n = 12;
  const Surface surface = flat("half", {{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1)}});
  const TexelAreas texels = texelAreas(surface, {n, n, {}});
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const double expected = column > row ? 1 : column == row ? 0.5 : 0;
      CHECK(texels.coverage[std::size_t(row * n + column)] == Approx(expected).margin(1e-14));
    }
}

TEST_CASE("texelAreas of a non-planar quad follow from the triangle that contains the texel", "[texels]") {
  // Each triangle is mapped affinely, so that a texel completely inside one has area(triangle) / (area on the chart) /
  // n^2.
  const Surface surface = quad("warped", {{{0, 0, 0}, {2, 0, 1}, {2, 3, -1}, {0, 1, 2}}});
  const int n = 8;
  const TexelAreas texels = texelAreas(surface, {n, n, {}});
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const double lower = area(surface.triangles[0]) * 2 / (n * n), upper = area(surface.triangles[1]) * 2 / (n * n);
      const double expected = column > row ? lower : column < row ? upper : (lower + upper) / 2;
      CHECK(texels.area[std::size_t(row * n + column)] == Approx(expected).epsilon(1e-13));
    }
}

TEST_CASE("texelAreas name a triangle that covers the texel's middle if there is one", "[texels]") {
  for (const Surface& surface : tableOfSurfaces()) {
    const int columns = 21, rows = 17;
    const TexelAreas texels = texelAreas(surface, {columns, rows, {}});
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const glm::dvec2 middle(column + 0.5, row + 0.5);
        std::uint32_t first = 0;
        while (first < surface.triangles.size() &&
               !weightsAt(inTexels(surface.triangles[first], columns, rows), middle))
          ++first;
        if (first < surface.triangles.size()) CHECK(texels.triangle[std::size_t(row * columns + column)] == first);
      }
  }
}

TEST_CASE("texelAreas name the triangle of the largest piece if none covers the texel's middle", "[texels]") {
  // Two rectangles in the corners of a 1 x 1 grid: 0.1 x 0.1 and 0.2 x 0.3; the latter is cut into triangles 2 and 3.
  const Surface surface = flat("corners", joined(rectangle({0, 0}, {0.1, 0.1}), rectangle({0.8, 0.7}, {1, 1})));
  CHECK(texelAreas(surface, {1, 1, {}}).triangle.front() >= 2);
}

TEST_CASE("texelAreas keep the area of a triangle whose chart collapses", "[texels]") {
  // The whole chart has area 1, and a triangle collapsed to one point of it 1/2: also at the upper right, beyond the
  // last texel.
  for (const glm::dvec2& point : {glm::dvec2(0.5, 0.5), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
    Surface surface = flat("flat", rectangle({0, 0}, {1, 1}));
    surface.triangles.push_back(triangleOf({{0, 0, 1}, point}, {{1, 0, 1}, point}, {{0, 1, 1}, point}));
    const TexelAreas texels = texelAreas(surface, {4, 4, {}});
    CHECK(sumOf(texels.area) == Approx(1.5).epsilon(1e-14));
    CHECK(sumOf(texels.coverage) == Approx(16).epsilon(1e-14));
  }
}
