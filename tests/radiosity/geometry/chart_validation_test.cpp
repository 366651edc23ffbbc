// chartConflicts finds overlaps but not contacts, compared with the clipped area of pairs of triangles.
#include "radiosity/geometry/chart_validation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>
#include <random>

#include "raster/base/cross.h"

using namespace hemitex;
using radiosity::ChartConflict;
using radiosity::chartConflicts;
using radiosity::chartTolerance;
using radiosity::ChartTriangle;
using Kind = ChartConflict::Kind;

namespace {

using Points = std::vector<glm::dvec2>;

double area(const Points& polygon) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += raster::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]) / 2;
  }
  return sum;
}

Points counterClockwise(const ChartTriangle& t) {
  Points points(t.begin(), t.end());
  if (area(points) < 0) std::swap(points[1], points[2]);
  return points;
}

/// The common area of two triangles, by Sutherland-Hodgman.
double sharedArea(const ChartTriangle& s, const ChartTriangle& t) {
  Points shared = counterClockwise(s);
  const Points clip = counterClockwise(t);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = clip[i], edge = clip[(i + 1) % 3] - a;
    Points inside;
    for (std::size_t j = 0; j < shared.size(); ++j) {
      const glm::dvec2 p = shared[j], q = shared[(j + 1) % shared.size()];
      const double hp = raster::cross(edge, p - a), hq = raster::cross(edge, q - a);
      if (hp >= 0) inside.push_back(p);
      if ((hp >= 0) != (hq >= 0)) inside.push_back(p + hp / (hp - hq) * (q - p));
    }
    shared = inside;
  }
  return area(shared);
}

/// n x n squares over the whole chart, two triangles each, every other square mirrored.
std::vector<ChartTriangle> squares(int n) {
  std::vector<ChartTriangle> triangles;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const glm::dvec2 a = glm::dvec2(i, j) / double(n), b = glm::dvec2(i + 1, j) / double(n);
      const glm::dvec2 c = glm::dvec2(i + 1, j + 1) / double(n), d = glm::dvec2(i, j + 1) / double(n);
      triangles.push_back({a, b, c});
      triangles.push_back((i + j) % 2 == 0 ? ChartTriangle{a, c, d} : ChartTriangle{a, d, c});
    }
  }
  return triangles;
}

std::vector<ChartTriangle> rounded(std::vector<ChartTriangle> triangles) {
  for (ChartTriangle& triangle : triangles) triangle = radiosity::roundedChart(triangle);
  return triangles;
}

}  // namespace

TEST_CASE("chartConflicts accepts a grid of squares, mirrored or not, rounded or not", "[chart]") {
  for (const int n : {1, 2, 7, 100}) {
    CHECK(chartConflicts(squares(n)).empty());
    CHECK(chartConflicts(rounded(squares(n))).empty());
  }
  CHECK(chartConflicts({}).empty());
}

TEST_CASE("chartConflicts counts an overlap from the tolerance on", "[chart]") {
  // Two triangles left and right of u = 0.5; the right one is moved into the left one by `depth`.
  const auto conflicts = [](double depth) {
    const double u = 0.5 - depth;
    return chartConflicts(std::vector<ChartTriangle>{{glm::dvec2(0, 0), glm::dvec2(0.5, 0.2), glm::dvec2(0.5, 0.8)},
                                                     {glm::dvec2(u, 0.2), glm::dvec2(1, 0.5), glm::dvec2(u, 0.8)}});
  };
  CHECK(conflicts(0).empty());
  CHECK(conflicts(0.9 * chartTolerance).empty());
  REQUIRE(conflicts(1.1 * chartTolerance).size() == 1);
  CHECK(conflicts(1.1 * chartTolerance)[0].kind == Kind::Overlap);
  CHECK(conflicts(1.1 * chartTolerance)[0].triangle == 1);
  CHECK(conflicts(1.1 * chartTolerance)[0].other == 0);
}

TEST_CASE("chartConflicts finds triangles outside the square or without area", "[chart]") {
  const glm::dvec2 o(0, 0), u(1, 0), v(0, 1);
  const auto kindOf = [](const ChartTriangle& triangle) {
    const std::vector<ChartConflict> conflicts = chartConflicts(std::vector<ChartTriangle>{triangle});
    return conflicts.empty() ? std::optional<Kind>() : conflicts[0].kind;
  };
  CHECK_FALSE(kindOf({o, u, v}));
  CHECK_FALSE(kindOf({o, v, u}));
  CHECK(kindOf({o, u, glm::dvec2(0, 1.0001)}) == Kind::Outside);
  CHECK(kindOf({o, u, glm::dvec2(-1e-9, 1)}) == Kind::Outside);
  CHECK(kindOf({o, u, glm::dvec2(1e300, -1e300)}) == Kind::Outside);
  CHECK(kindOf({o, u, u}) == Kind::NoArea);
  CHECK(kindOf({o, glm::dvec2(0.25, 0.75), glm::dvec2(0x1p-24, 3 * 0x1p-24)}) == Kind::NoArea);
  CHECK_FALSE(kindOf({o, glm::dvec2(0.25, 0.75), glm::dvec2(0x1p-24, 2 * 0x1p-24)}));
}

TEST_CASE("chartConflicts tests triangles against those that stay", "[chart]") {
  // The second overlaps the first and is removed. The third overlaps only the second and stays. The fourth equals the
  // third.
  const ChartTriangle first{glm::dvec2(0, 0), glm::dvec2(0.4, 0), glm::dvec2(0, 1)};
  const ChartTriangle second{glm::dvec2(0.1, 0), glm::dvec2(0.9, 0), glm::dvec2(0.1, 1)};
  const ChartTriangle third{glm::dvec2(0.6, 0), glm::dvec2(1, 0), glm::dvec2(0.6, 1)};
  const std::vector<ChartTriangle> triangles{first, second, third, third};
  const std::vector<ChartConflict> conflicts = chartConflicts(triangles);
  REQUIRE(conflicts.size() == 2);
  CHECK(conflicts[0].triangle == 1);
  CHECK(conflicts[1].triangle == 3);
  CHECK(conflicts[1].other == 2);
  CHECK(chartConflicts(triangles, 1).size() == 1);
}

TEST_CASE("chartConflicts of random triangles are those that clipping finds", "[chart]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0), near(-0.12, 0.12);
  int overlaps = 0, stays = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<ChartTriangle> triangles;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec2 centre(anywhere(random), anywhere(random));
      ChartTriangle triangle;
      for (glm::dvec2& p : triangle) p = glm::clamp(centre + glm::dvec2(near(random), near(random)), 0.0, 1.0);
      if (std::abs(area(counterClockwise(triangle))) > 1e-4) triangles.push_back(triangle);
    }
    const std::vector<ChartConflict> conflicts = chartConflicts(triangles);
    std::vector<ChartTriangle> kept;
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      double largest = 0;
      for (const ChartTriangle& other : kept) largest = std::max(largest, sharedArea(triangles[i], other));
      const bool isConflict = next < conflicts.size() && conflicts[next].triangle == i;
      // A penetration above the tolerance may share an area as small as the tolerance squared; no smaller penetration
      // shares more than tolerance x 1.
      if (largest > chartTolerance) CHECK(isConflict);
      if (largest == 0) CHECK_FALSE(isConflict);
      if (isConflict) ++next, ++overlaps;
      if (!isConflict) kept.push_back(triangles[i]), ++stays;
    }
  }
  CHECK(overlaps > 1000);
  CHECK(stays > 1000);
}

TEST_CASE("chartConflicts works for charts of long strips and of fans", "[chart]") {
  std::vector<ChartTriangle> strips, fan;
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    const double u = double(i) / n, w = double(i + 1) / n;
    strips.push_back({glm::dvec2(u, 0), glm::dvec2(w, 0), glm::dvec2(w, 1)});
    strips.push_back({glm::dvec2(u, 0), glm::dvec2(w, 1), glm::dvec2(u, 1)});
    fan.push_back({glm::dvec2(0, 0), glm::dvec2(1, u), glm::dvec2(1, w)});
  }
  CHECK(chartConflicts(strips).empty());
  CHECK(chartConflicts(fan).empty());
  strips.push_back({glm::dvec2(0, 0.5), glm::dvec2(1, 0.5), glm::dvec2(1, 0.50001)});
  fan.push_back({glm::dvec2(0.9, 0), glm::dvec2(0.9001, 0), glm::dvec2(0.9001, 0.9)});
  CHECK(chartConflicts(strips).size() == 1);
  CHECK(chartConflicts(fan).size() == 1);
}
