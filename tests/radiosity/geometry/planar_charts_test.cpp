// planarParts: the number of parts, their triangles, and charts that are the scaled plane.
#include "radiosity/geometry/planar_charts.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace hemitex;
using radiosity::ChartTriangle;
using radiosity::PlanarPart;
using radiosity::planarParts;
using radiosity::TrianglePositions;

namespace {

using Triangles = std::vector<TrianglePositions>;

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
void checkParts(const Triangles& triangles, const std::vector<PlanarPart>& parts) {
  std::vector<int> times(triangles.size(), 0);
  for (const PlanarPart& part : parts) {
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
  const std::vector<PlanarPart> parts = planarParts(cube());
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
    const std::vector<PlanarPart> parts = planarParts(side);
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
  const std::vector<PlanarPart> parts = planarParts(triangles);
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
  const std::vector<PlanarPart> parts = planarParts(Triangles{{a, b, c}});
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
  const PlanarPart part = planarParts(square).at(0);
  CHECK(part.charts[0] == ChartTriangle{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1)});
  CHECK(part.charts[1] == ChartTriangle{glm::dvec2(0, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)});
}

TEST_CASE("planarParts gives repeated faces charts of their own", "[planar]") {
  Triangles triangles = cube();
  const Triangles again = cube();
  triangles.insert(triangles.end(), again.begin(), again.end());
  triangles.insert(triangles.end(), again.begin(), again.end());
  const std::vector<PlanarPart> parts = planarParts(triangles);
  checkParts(triangles, parts);
  CHECK(parts.size() == 18);
  for (const PlanarPart& part : parts) CHECK(radiosity::chartConflicts(part.charts).empty());
  for (std::size_t p = 1; p < parts.size(); ++p) CHECK(parts[p - 1].triangles[0] < parts[p].triangles[0]);
}

TEST_CASE("planarParts gives a triangle too thin for its part's chart a chart of its own", "[planar]") {
  Triangles triangles;
  addQuad(triangles, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  triangles.push_back({glm::dvec3(0, 0, 0), glm::dvec3(0.5, -1e-9, 0), glm::dvec3(1, 0, 0)});
  const std::vector<PlanarPart> parts = planarParts(triangles);
  checkParts(triangles, parts);
  CHECK(parts.size() == 2);
}
