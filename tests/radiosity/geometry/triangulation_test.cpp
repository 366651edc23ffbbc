// Triangulation covers a polygon exactly once if two conditions hold: its triangles have the winding of the polygon,
// and their edges cancel except for the outline. (The winding numbers of the triangles add up to that of the polygon,
// which is 1 inside; none is negative.)
#include "radiosity/geometry/triangulation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

using namespace hemitex;
using radiosity::hasArea;
using radiosity::triangulate;
using radiosity::Triangulation;

namespace {

using Polygon = std::vector<glm::dvec3>;

/// The same polygon three times: in the plane z = 0, in a tilted plane far from the origin, and in one seen from
/// behind.
std::vector<Polygon> placed(const std::vector<glm::dvec2>& outline) {
  const glm::dvec3 u(0.6, 0.0, 0.8), v(-0.48, 0.8, 0.36), far(1000, -2000, 500);
  std::vector<Polygon> polygons(3);
  for (const glm::dvec2& p : outline) {
    polygons[0].emplace_back(p.x, p.y, 0);
    polygons[1].push_back(far + p.x * u + p.y * v);
    polygons[2].push_back(p.x * v + p.y * u);
  }
  return polygons;
}

glm::dvec3 areaVector(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 0.5 * glm::cross(b - a, c - a);
}

/// The shoelace formula, in space.
glm::dvec3 areaVector(const Polygon& polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += areaVector(polygon[0], polygon[i], polygon[i + 1]);
  return sum;
}

/// Directed edges; opposite ones cancel.
using Chain = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void addEdge(Chain& chain, std::uint32_t from, std::uint32_t to) {
  int& count = from < to ? chain[{from, to}] : chain[{to, from}];
  count += from < to ? 1 : -1;
  if (count == 0) chain.erase(std::minmax(from, to));
}

void checkCovers(const Polygon& polygon, const Triangulation& cut) {
  const auto n = static_cast<std::uint32_t>(polygon.size());
  const glm::dvec3 whole = areaVector(polygon);
  CHECK_FALSE(cut.crossing);
  CHECK(cut.triangles.size() == n - 2);
  Chain outline, edges;
  double area = 0;
  bool allWindAlike = true;
  for (std::uint32_t i = 0; i < n; ++i) addEdge(outline, i, (i + 1) % n);
  for (const auto& [a, b, c] : cut.triangles) {
    addEdge(edges, a, b);
    addEdge(edges, b, c);
    addEdge(edges, c, a);
    if (!hasArea(polygon[a], polygon[b], polygon[c])) continue;
    const glm::dvec3 part = areaVector(polygon[a], polygon[b], polygon[c]);
    allWindAlike = allWindAlike && glm::dot(part, whole) > 0;
    area += glm::length(part);
  }
  CHECK(allWindAlike);
  CHECK(edges == outline);
  CHECK(area == Approx(glm::length(whole)).epsilon(1e-9));
}

/// Ear clipping as triangulation.h defines it, for polygons with integer-like outlines in the plane z = 0: tests all
/// corners in turn, and each against all others. Empty for polygons of which triangulate makes a fan.
Triangulation cutInTurn(const Polygon& polygon) {
  double largest = 0;
  for (const glm::dvec3& p : polygon) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
  const double noise = 4 * std::numeric_limits<double>::epsilon() * largest;
  glm::dvec3 normal(0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  if (normal.z == 0) return {};
  // The axes of triangulate for a normal along z.
  std::vector<glm::dvec2> points;
  for (const glm::dvec3& p : polygon) {
    const glm::dvec3 from = p - polygon[0];
    points.emplace_back(normal.z > 0 ? from.y : -from.y, -from.x);
  }
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec2 ab = points[b] - points[a], ac = points[c] - points[a], bc = points[c] - points[b];
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (std::fabs(area) <= noise * std::sqrt(std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)})))
      return 0;
    return area > 0 ? 1 : -1;
  };
  std::vector<std::uint32_t> ring;
  for (std::uint32_t i = 0; i < points.size(); ++i) ring.push_back(i);
  bool isConvex = true;
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % ring.size());
    if (turn(i, next, static_cast<std::uint32_t>((i + 2) % ring.size())) < 0 || turn(0, i, next) < 0) isConvex = false;
  }
  if (isConvex) return {};
  Triangulation result;
  std::size_t at = 0, refused = 0;
  while (ring.size() > 3) {
    const std::uint32_t a = ring[(at + ring.size() - 1) % ring.size()], b = ring[at], c = ring[(at + 1) % ring.size()];
    const bool isEmpty = std::none_of(ring.begin(), ring.end(), [&](std::uint32_t q) {
      if (points[q] == points[a] || points[q] == points[b] || points[q] == points[c]) return false;
      return turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0;
    });
    const bool isEar = turn(a, b, c) > 0 && isEmpty, isStraight = turn(a, b, c) == 0 && refused >= ring.size();
    if (isEar || isStraight || refused >= 2 * ring.size()) {
      result.triangles.push_back({a, b, c});
      result.crossing = result.crossing || !(isEar || isStraight);
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
      refused = 0;
    } else {
      ++at;
      ++refused;
    }
    at %= ring.size();
  }
  result.triangles.push_back({ring[0], ring[1], ring[2]});
  result.crossing = result.crossing || turn(ring[0], ring[1], ring[2]) < 0;
  return result;
}

}  // namespace

TEST_CASE("triangulate makes a fan of a convex polygon from its first corner", "[triangulate]") {
  for (const int n : {3, 4, 5, 17, 300}) {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < n; ++i) outline.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n));
    for (const Polygon& polygon : placed(outline)) {
      const Triangulation cut = triangulate(polygon);
      checkCovers(polygon, cut);
      for (std::uint32_t i = 0; i < cut.triangles.size(); ++i) {
        CHECK(cut.triangles[i] == std::array<std::uint32_t, 3>{0, i + 1, i + 2});
      }
    }
  }
}

TEST_CASE("triangulate makes a fan of a convex polygon with corners on straight edges", "[triangulate]") {
  // 0.1 and 0.7 are not binary numbers, so that the middle corners lie on their edges only up to rounding.
  for (const Polygon& polygon : placed({{0.1, 0.1}, {0.4, 0.1}, {0.7, 0.1}, {0.7, 0.4}, {0.7, 0.7}, {0.1, 0.7}})) {
    const Triangulation cut = triangulate(polygon);
    checkCovers(polygon, cut);
    CHECK(cut.triangles[0] == std::array<std::uint32_t, 3>{0, 1, 2});
    CHECK(cut.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
  }
}

TEST_CASE("triangulate accepts a quad that is not planar", "[triangulate]") {
  const Polygon saddle{{0, 0, 0.3}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0}};
  CHECK(triangulate(saddle).triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("triangulate covers concave polygons exactly once", "[triangulate]") {
  const auto outline = GENERATE(values<std::vector<glm::dvec2>>({
      {{0, 0}, {4, 0}, {1, 1}, {0, 4}},                                    // an arrow head
      {{1, 1}, {0, 4}, {0, 0}, {4, 0}},                                    // the same from its notch
      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},                    // an L
      {{0, 0}, {1.5, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {1, 3}, {0, 3}},  // an L with corners on its edges
      {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},  // a comb
      {{0, 0},
       {6, 0},
       {6, 6},
       {0, 6},
       {0, 2},
       {4, 2},
       {4, 4},
       {2, 4},
       {2, 3},
       {3, 3},
       {3, 2.5},
       {1, 2.5},
       {1, 5},
       {5, 5},
       {5, 1},
       {0, 1}},                                                                          // a spiral
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},  // a frame: a hole, connected
                                                                                         // by an edge
  }));
  for (const Polygon& polygon : placed(outline)) checkCovers(polygon, triangulate(polygon));
}

TEST_CASE("triangulate covers random star-shaped polygons exactly once", "[triangulate]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.05, 1.0);
  for (int n = 4; n <= 120; ++n) {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < n; ++i) {
      const double r = radius(random), angle = 2 * M_PI * i / n;
      outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    CAPTURE(n);
    for (const Polygon& polygon : placed(outline)) checkCovers(polygon, triangulate(polygon));
  }
}

TEST_CASE("triangulate cuts off the same ears in the same order as a search that visits all corners", "[triangulate]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::vector<glm::dvec3> grid = [] {  // coarse coordinates, so that many corners coincide or are collinear
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 25; ++i) points.emplace_back(i % 5, i / 5, 0);
    return points;
  }();
  for (int run = 0; run < 300; ++run) {
    const int n = 4 + static_cast<int>(unit(random) * 200);
    Polygon star, crossing, coarse;
    for (int i = 0; i < n; ++i) {
      const double r = 0.05 + unit(random), angle = 2 * M_PI * i / n;
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
      crossing.emplace_back(unit(random), unit(random), 0);
      coarse.push_back(grid[static_cast<std::size_t>(unit(random) * 25)]);
    }
    CAPTURE(run, n);
    for (const Polygon& polygon : {star, crossing, coarse}) {
      const Triangulation cut = triangulate(polygon), expected = cutInTurn(polygon);
      if (expected.triangles.empty()) continue;  // convex, or without area
      REQUIRE(cut.triangles == expected.triangles);
      REQUIRE(cut.crossing == expected.crossing);
    }
  }
}

TEST_CASE("triangulate covers polygons of 100,000 corners exactly once", "[triangulate]") {
  constexpr int n = 100000;
  Polygon comb{{0, 0, 0}, {n / 4, 0, 0}}, spiral, notched;
  for (int tooth = n / 4 - 1; tooth >= 0; --tooth)
    for (const glm::dvec2& p : {glm::dvec2(0.75, 900), glm::dvec2(0.5, 1), glm::dvec2(0.25, 1000), glm::dvec2(0, 0.5)})
      comb.emplace_back(tooth + p.x, p.y, 0);
  for (int i = 0; i < n / 2; ++i) {
    const double angle = i * 0.0125, r = 1 + 0.1 * angle;
    spiral.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  for (int i = n / 2 - 1; i >= 0; --i)
    spiral.push_back(spiral[static_cast<std::size_t>(i)] * (1 + 0.2 / (1 + 0.00125 * i)));
  for (int i = 0; i < n; ++i) {
    const double r = i % 2 == 0 ? 1 : 0.999, angle = 2 * M_PI * i / n;
    notched.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  for (const Polygon& polygon : {comb, spiral, notched}) checkCovers(polygon, triangulate(polygon));
}

TEST_CASE("triangulate reports a polygon that crosses itself, and still makes two triangles less than corners",
          "[triangulate]") {
  const auto outline = GENERATE(values<std::vector<glm::dvec2>>({
      {{0, 0}, {1, 1}, {1, 0}, {0, 1}},              // a bow tie whose halves cancel
      {{0, 0}, {2, 2}, {2, 0}, {0, 1}},              // one whose halves do not
      {{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}},  // a pentagram
  }));
  for (const Polygon& polygon : placed(outline)) {
    const Triangulation cut = triangulate(polygon);
    CHECK(cut.crossing);
    CHECK(cut.triangles.size() == polygon.size() - 2);
  }
}

TEST_CASE("hasArea is true where the height of a triangle is above the rounding noise of its coordinates",
          "[triangulate]") {
  // The largest coordinate is 1, so that the limit is 4 epsilons; the base is 1 long, and the apex over its middle.
  const double epsilon = std::numeric_limits<double>::epsilon();
  const glm::dvec3 a(0, 0, 0), b(1, 0, 0);
  CHECK_FALSE(hasArea(a, b, {0.5, 0, 0}));
  CHECK_FALSE(hasArea(a, b, {0.5, 4 * epsilon, 0}));
  CHECK(hasArea(a, b, {0.5, 4.1 * epsilon, 0}));
  CHECK_FALSE(hasArea(a, a, b));
  CHECK_FALSE(hasArea(a, a, a));
  // A million units away the same triangle of size 1 needs a million times the height.
  const glm::dvec3 far(1e6, 0, 0);
  CHECK_FALSE(hasArea(a + far, b + far, glm::dvec3(0.5, 3.9e6 * epsilon, 0) + far));
  CHECK(hasArea(a + far, b + far, glm::dvec3(0.5, 4.1e6 * epsilon, 0) + far));
  // Collinear points stay without area when decimals round them.
  CHECK_FALSE(hasArea({0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.3, 0.6, 0.9}));
}
