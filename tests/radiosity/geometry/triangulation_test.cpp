// Triangulation covers a polygon exactly once if two conditions hold: its triangles have the winding of the polygon,
// and their edges cancel except for the outline. (The winding numbers of the triangles add up to that of the polygon,
// which is 1 inside; none is negative.)
#include "radiosity/geometry/triangulation.h"

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
