// planarParts and curvedParts: the number of parts, their triangles, and charts that are scaled projections.
#include "radiosity/geometry/mesh_charts.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/support/ball.h"

using namespace hemitex;
using radiosity::ChartedPart;
using radiosity::ChartTriangle;
using radiosity::curvedParts;
using radiosity::TrianglePositions;

namespace {

using Triangles = std::vector<TrianglePositions>;

/// Each triangle is a face.
std::vector<std::uint32_t> facesOf(const Triangles& triangles) {
  std::vector<std::uint32_t> faces(triangles.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

std::vector<ChartedPart> planarParts(const Triangles& triangles) {
  return radiosity::planarParts(triangles, facesOf(triangles));
}

void addQuad(Triangles& triangles, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

Triangles cube() {
  Triangles triangles;
  addQuad(triangles, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0});
  addQuad(triangles, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1});
  addQuad(triangles, {0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1});
  addQuad(triangles, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1});
  addQuad(triangles, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1});
  addQuad(triangles, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1});
  return triangles;
}

double doubledArea(const ChartTriangle& t) {
  const glm::dvec2 ab = t[1] - t[0], ac = t[2] - t[0];
  return ab.x * ac.y - ab.y * ac.x;
}

double doubledArea(const TrianglePositions& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); }

/// Each triangle is in one part. Charts stay in the square, are not mirrored, and scale all areas of a part equally.
void checkParts(const Triangles& triangles, const std::vector<ChartedPart>& parts) {
  std::vector<int> times(triangles.size(), 0);
  for (const ChartedPart& part : parts) {
    REQUIRE(part.triangles.size() == part.charts.size());
    const double scale = doubledArea(part.charts[0]) / doubledArea(triangles[part.triangles[0]]);
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      ++times[part.triangles[i]];
      CHECK(doubledArea(part.charts[i]) > 0);
      CHECK(doubledArea(part.charts[i]) == Approx(scale * doubledArea(triangles[part.triangles[i]])).epsilon(1e-4));
      for (const glm::dvec2& p : part.charts[i]) {
        CHECK(glm::all(glm::greaterThanEqual(p, glm::dvec2(0)) && glm::lessThanEqual(p, glm::dvec2(1))));
        CHECK(glm::fract(p * 0x1p24) == glm::dvec2(0));
      }
    }
  }
  CHECK(times == std::vector<int>(triangles.size(), 1));
}

}  // namespace

TEST_CASE("planarParts of a cube are six, each a whole chart", "[planar]") {
  const std::vector<ChartedPart> parts = planarParts(cube());
  checkParts(cube(), parts);
  REQUIRE(parts.size() == 6);
  for (std::uint32_t p = 0; p < 6; ++p) {
    CHECK(parts[p].triangles == std::vector<std::uint32_t>{2 * p, 2 * p + 1});
    CHECK(doubledArea(parts[p].charts[0]) + doubledArea(parts[p].charts[1]) == 2);
  }
}

TEST_CASE("planarParts of the side of a prism are its facets", "[planar]") {
  for (const int n : {3, 16, 500}) {
    Triangles side;
    for (int i = 0; i < n; ++i) {
      // The last facet shares its exact coordinates with the first.
      const double a = 2 * M_PI * i / n, b = 2 * M_PI * ((i + 1) % n) / n;
      addQuad(side, {std::cos(a), std::sin(a), 0}, {std::cos(b), std::sin(b), 0}, {std::cos(b), std::sin(b), 5},
              {std::cos(a), std::sin(a), 5});
    }
    const std::vector<ChartedPart> parts = planarParts(side);
    checkParts(side, parts);
    CHECK(parts.size() == static_cast<std::size_t>(n));
  }
}

TEST_CASE("planarParts separates triangles in one plane that do not touch", "[planar]") {
  Triangles triangles;
  addQuad(triangles, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  addQuad(triangles, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0});
  addQuad(triangles, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0});  // touches both only in a corner
  CHECK(planarParts(triangles).size() == 3);
  addQuad(triangles, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0});  // closes the gap
  const std::vector<ChartedPart> parts = planarParts(triangles);
  CHECK(parts.size() == 1);
  checkParts(triangles, parts);
}

TEST_CASE("planarParts separates triangles that meet back to back", "[planar]") {
  const Triangles triangles{{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)},
                            {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)}};
  CHECK(planarParts(triangles).size() == 2);
}

TEST_CASE("planarParts lets a part bend by up to 1e-4 rad from its first triangle", "[planar]") {
  // Three strips along x with common edges along y, each rising by `angle` more.
  const auto parts = [](double angle) {
    Triangles strips;
    glm::dvec3 at(0.0);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 next = at + glm::dvec3(std::cos(i * angle), 0, std::sin(i * angle));
      addQuad(strips, at, next, next + glm::dvec3(0, 1, 0), at + glm::dvec3(0, 1, 0));
      at = next;
    }
    return planarParts(strips).size();
  };
  CHECK(parts(0.49e-4) == 1);
  CHECK(parts(0.51e-4) == 2);  // the third strip is too steep for the first
  CHECK(parts(0.99e-4) == 2);
  CHECK(parts(1.01e-4) == 3);
}

TEST_CASE("planarParts makes the chart the bounding rectangle along the longest boundary edge", "[planar]") {
  // A right triangle with legs 3 and 4: along its hypotenuse of 5 the foot of its height 12/5 is at 9/5.
  const glm::dvec3 b(3, 0, 0), c(0, 4, 0), a(0, 0, 0);
  const std::vector<ChartedPart> parts = planarParts(Triangles{{a, b, c}});
  REQUIRE(parts.size() == 1);
  const ChartTriangle& chart = parts[0].charts[0];
  CHECK(chart[1] == glm::dvec2(0, 0));
  CHECK(chart[2] == glm::dvec2(1, 0));
  CHECK(std::fabs(chart[0].x - 9.0 / 25) <= 0x1p-25);
  CHECK(chart[0].y == 1);
}

TEST_CASE("planarParts does not rotate the chart along inner edges", "[planar]") {
  // The diagonal of the square is its longest edge, but an inner one: the chart stays along the sides.
  Triangles square;
  addQuad(square, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const ChartedPart part = planarParts(square).at(0);
  CHECK(part.charts[0] == ChartTriangle{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1)});
  CHECK(part.charts[1] == ChartTriangle{glm::dvec2(0, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)});
}

TEST_CASE("planarParts gives repeated faces charts of their own", "[planar]") {
  Triangles triangles = cube();
  const Triangles again = cube();
  triangles.insert(triangles.end(), again.begin(), again.end());
  triangles.insert(triangles.end(), again.begin(), again.end());
  const std::vector<ChartedPart> parts = planarParts(triangles);
  checkParts(triangles, parts);
  CHECK(parts.size() == 18);
  for (const ChartedPart& part : parts) CHECK(radiosity::chartConflicts(part.charts).empty());
  for (std::size_t p = 1; p < parts.size(); ++p) CHECK(parts[p - 1].triangles[0] < parts[p].triangles[0]);
}

TEST_CASE("planarParts gives a triangle too thin for its part's chart a chart of its own", "[planar]") {
  Triangles triangles;
  addQuad(triangles, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  triangles.push_back({glm::dvec3(0, 0, 0), glm::dvec3(0.5, -1e-9, 0), glm::dvec3(1, 0, 0)});
  const std::vector<ChartedPart> parts = planarParts(triangles);
  checkParts(triangles, parts);
  CHECK(parts.size() == 2);
}

namespace {

std::vector<ChartedPart> curvedPartsOf(const Triangles& triangles, bool isSmooth = true) {
  return curvedParts(triangles, radiosity::findEdges(triangles), facesOf(triangles),
                     [=](auto, auto) { return isSmooth; });
}

/// Each triangle is in one part. The projection shortens each area to no less than half: within a part, areas in the
/// chart over areas on the surface differ by a factor of at most 2.
void checkCurvedParts(const Triangles& triangles, const std::vector<ChartedPart>& parts) {
  std::vector<int> times(triangles.size(), 0);
  for (const ChartedPart& part : parts) {
    CHECK(radiosity::chartConflicts(part.charts).empty());
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      ++times[part.triangles[i]];
      const double scale = doubledArea(part.charts[i]) / doubledArea(triangles[part.triangles[i]]);
      least = std::min(least, scale);
      most = std::max(most, scale);
    }
    CHECK(least > 0);
    CHECK(most <= 2 * least * (1 + 1e-4));
  }
  CHECK(times == std::vector<int>(triangles.size(), 1));
}

}  // namespace

// The sides of a cube, projected onto the sphere, are within 54.7 degrees of their middles. Fewer parts than four are
// not possible, since a part is seen from one direction at 60 degrees or less.
TEST_CASE("curvedParts of a ball are six caps", "[planar]") {
  for (const int levels : {2, 3, 4}) {
    const Triangles ball = tests::icosphere(levels);
    const std::vector<ChartedPart> parts = curvedPartsOf(ball);
    CHECK(parts.size() == 6);
    checkCurvedParts(ball, parts);
    for (const ChartedPart& part : parts) CHECK(part.component == 0U);
  }
}

TEST_CASE("curvedParts of a mesh without smooth edges are its triangles, and of a cube its planar parts", "[planar]") {
  const Triangles ball = tests::icosphere(0);
  CHECK(curvedPartsOf(ball, false).size() == 20);
  const Triangles sides = cube();
  const radiosity::MeshEdges edges = radiosity::findEdges(sides);
  const auto areInOnePlane = [&](std::uint32_t h, std::uint32_t other) {
    return radiosity::areParallel(radiosity::unitNormal(sides[h / 3]), radiosity::unitNormal(sides[other / 3]));
  };
  const std::vector<ChartedPart> parts = curvedParts(sides, edges, facesOf(sides), areInOnePlane),
                                 planar = planarParts(sides);
  REQUIRE(parts.size() == planar.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    CHECK(parts[p].triangles == planar[p].triangles);
    CHECK(parts[p].charts == planar[p].charts);
    CHECK_FALSE(parts[p].component);
  }
}

// A grid of hills of height h and width 1 is a graph over the plane, so that one projection maps it without overlap.
// Slopes are below pi h: 50 degrees for h = .38, and hills with steep parts need more charts.
TEST_CASE("curvedParts of gentle hills are one part; small steep places of others do not become parts", "[planar]") {
  const auto hills = [](double height) {
    const auto at = [&](int i, int j) {
      const double u = i / 12.0, v = j / 12.0;
      const auto wave = [](double x) { return 4 * (x - std::floor(x)) * (1 - x + std::floor(x)); };
      return glm::dvec3(u, v, height * wave(u) * wave(v));
    };
    Triangles triangles;
    for (int j = 0; j < 36; ++j)
      for (int i = 0; i < 36; ++i) addQuad(triangles, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return triangles;
  };
  CHECK(curvedPartsOf(hills(0.2)).size() == 1);
  const Triangles steep = hills(0.36);
  const std::vector<ChartedPart> parts = curvedPartsOf(steep);
  checkCurvedParts(steep, parts);
  CHECK(parts.size() == 1);
}
