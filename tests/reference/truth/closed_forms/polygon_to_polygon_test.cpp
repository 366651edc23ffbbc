// polygonToPolygon compared with closed forms of rectangles, quadrature, and closed solids.
#include "reference/truth/closed_forms/polygon_to_polygon.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/support/form_factor_quadrature.h"
#include "tests/truth/rectangles.h"

using namespace hemitex::reference;
using namespace hemitex::tests;

namespace {

using Polygon = std::vector<glm::dvec3>;

AxisRectangle rectangle(double x0, double x1, double y0, double y1) { return {{x0, x1}, {y0, y1}}; }

/// In the plane z = `z`, facing up.
Polygon floorOf(const AxisRectangle& r, double z = 0) {
  return {{r.first.low, r.second.low, z},
          {r.first.high, r.second.low, z},
          {r.first.high, r.second.high, z},
          {r.first.low, r.second.high, z}};
}

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// (x, z) in the plane y = 0, facing along y.
Polygon wallOf(const AxisRectangle& r) {
  return {{r.first.low, 0, r.second.low},
          {r.first.low, 0, r.second.high},
          {r.first.high, 0, r.second.high},
          {r.first.high, 0, r.second.low}};
}

Polygon moved(Polygon polygon, const glm::dmat3& turn, const glm::dvec3& by, double scale) {
  for (glm::dvec3& corner : polygon) corner = scale * (turn * corner + by);
  return polygon;
}

double areaOf(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return glm::length(sum) / 2;
}

/// The largest difference from 1 of the sum of form factors from a face of a closed convex solid to the others.
double worstClosure(const std::vector<Polygon>& faces) {
  double worst = 0;
  for (const Polygon& from : faces) {
    double sum = 0;
    for (const Polygon& to : faces)
      if (&from != &to) sum += polygonToPolygon(from, to);
    worst = std::max(worst, std::abs(sum - 1));
  }
  return worst;
}

/// A prism between z = 0 and z = length over the triangle of the origin, (1, 0) and the point at `angle`; faces
/// inwards.
std::vector<Polygon> wedge(double degrees, double length) {
  const double angle = degrees * std::numbers::pi / 180;
  const glm::dvec3 a(0), b(1, 0, 0), c(std::cos(angle), std::sin(angle), 0), up(0, 0, length);
  return {{a, b, c}, {a + up, c + up, b + up}, {a, a + up, b + up, b}, {b, b + up, c + up, c}, {c, c + up, a + up, a}};
}

/// Faces inwards.
std::vector<Polygon> tetrahedron(const std::array<glm::dvec3, 4>& p) {
  std::vector<Polygon> faces{{p[0], p[1], p[2]}, {p[0], p[2], p[3]}, {p[0], p[3], p[1]}, {p[1], p[3], p[2]}};
  const bool isTurned = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < 0;
  if (isTurned)
    for (Polygon& face : faces) face = reversed(face);
  return faces;
}

const std::vector<double> gaps{1e-6, 0.1, 1, 1e4};
const std::vector<double> polygonScales{1, 1e-6, 1e6};

}  // namespace

TEST_CASE("polygonToPolygon of equal parallel squares equals the closed form, at all gaps and scales",
          "[form factors]") {
  const AxisRectangle square = rectangle(0, 1, 0, 1);
  for (const double gap : gaps)
    for (const double scale : polygonScales) {
      const AxisRectangle r = rectangle(0, scale, 0, scale);
      CHECK(relativeError(polygonToPolygon(floorOf(r), reversed(floorOf(r, gap * scale))),
                          parallelRectangles(square, square, gap)) < 1e-10);
    }
}

TEST_CASE("polygonToPolygon of unequal parallel rectangles equals the closed form, also for slivers",
          "[form factors]") {
  const std::vector<std::array<AxisRectangle, 2>> pairs{
      {rectangle(0, 1, 0, 1), rectangle(-1, 0.5, 0.25, 1)},
      {rectangle(0, 1, 0, 1), rectangle(1, 2, 1, 3)},  // a corner above a corner
      {rectangle(0, 1, 0, 1e-6), rectangle(0, 1, 0, 1e-6)},
      {rectangle(0, 1, 0, 1e-6), rectangle(0.25, 0.250001, -3, 1)},
      {rectangle(0, 1, 0, 1e-3), rectangle(2, 3, 0, 1)},
  };
  for (const double gap : gaps)
    for (const auto& [from, to] : pairs)
      CHECK(relativeError(polygonToPolygon(floorOf(from), reversed(floorOf(to, gap))),
                          parallelRectangles(from, to, gap)) < 1e-10);
}

TEST_CASE("polygonToPolygon of rectangles at a right angle equals the closed form, whatever they share",
          "[form factors]") {
  const std::vector<std::array<AxisRectangle, 2>> pairs{
      {rectangle(0, 1, 0, 1), rectangle(0, 1, 0, 1)},     // an edge
      {rectangle(0, 1, 0, 1), rectangle(0.25, 3, 0, 2)},  // a part of an edge
      {rectangle(0, 1, 0, 1), rectangle(1, 2, 0, 1)},     // a corner
      {rectangle(0, 1, 0, 1), rectangle(0, 1, 1e-6, 1)},  // all but an edge
      {rectangle(0, 1, 1e-3, 1), rectangle(0.5, 1, 0, 1)},
      {rectangle(0, 1, 0.5, 1), rectangle(5, 6, 0.25, 1)},   // nothing
      {rectangle(0, 1, 0, 1e-6), rectangle(0, 1, 0, 1e-6)},  // slivers
      {rectangle(0, 1, 0, 1), rectangle(0, 1, 0, 1e-6)},
      {rectangle(0, 1e-6, 0, 1), rectangle(0, 1e-6, 0, 1)},
  };
  for (const auto& [from, to] : pairs)
    CHECK(relativeError(polygonToPolygon(floorOf(from), wallOf(to)), perpendicularRectangles(from, to)) < 1e-10);
}

TEST_CASE("polygonToPolygon does not change if both polygons are rotated, moved and scaled", "[form factors]") {
  // Rotated coordinates are rounded by 1e-16 of the sizes. So the form factor over a gap of 1e-3 changes by about
  // 1e-13, and after a move by 1000 by 1e-10.
  const double angle = 0.7;
  const glm::dmat3 aboutZ{{std::cos(angle), std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0}, {0, 0, 1}};
  const glm::dmat3 aboutX{{1, 0, 0}, {0, std::cos(angle), std::sin(angle)}, {0, -std::sin(angle), std::cos(angle)}};
  const glm::dmat3 turn = aboutX * aboutZ;
  const AxisRectangle from = rectangle(0, 1, 0, 1), to = rectangle(-1, 0.5, 0.25, 1);
  for (const double scale : polygonScales) {
    const Polygon floor = moved(floorOf(from), turn, {1, 2, 3}, scale);
    CHECK(relativeError(polygonToPolygon(floor, moved(wallOf(from), turn, {1, 2, 3}, scale)),
                        perpendicularRectangles(from, from)) < 1e-12);
    for (const double gap : {1e-3, 1.0, 1e4})
      CHECK(relativeError(polygonToPolygon(floor, moved(reversed(floorOf(to, gap)), turn, {1, 2, 3}, scale)),
                          parallelRectangles(from, to, gap)) < 1e-10);
  }
}

TEST_CASE("polygonToPolygon of distant parallelograms equals quadrature", "[form factors]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto direction = [&] {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return glm::dvec3(x, y, z);
  };
  int count = 0;
  for (const double distance : {5.0, 100.0, 1e4})
    for (int i = 0; i < 100; ++i) {
      const Parallelogram from{{}, direction(), direction()}, to{{0, 0, distance}, direction(), direction()};
      const glm::dvec3 up(0, 0, 1);
      if (glm::dot(from.areaVector(), up) < 0.5 * from.area() || glm::dot(to.areaVector(), up) > -0.5 * to.area())
        continue;
      ++count;
      CHECK(relativeError(polygonToPolygon(from.corners(), to.corners()), bruteForce(from, to)) < 1e-10);
    }
  CHECK(count > 10);
}

TEST_CASE("polygonToPolygon of the faces of a wedge sums to 1, at dihedral angles from 1 to 179 degrees",
          "[form factors]") {
  for (const double degrees : {1.0, 5.0, 30.0, 90.0, 120.0, 175.0, 179.0})
    for (const double length : {1.0, 30.0}) CHECK(worstClosure(wedge(degrees, length)) < 1e-11);
}

TEST_CASE("polygonToPolygon of the long sides of a wedge tends to Hottel's crossed strings", "[form factors]") {
  // F = 1 - sin(angle/2) for sides of length 1. For a wedge of length L with its ends, the rest is of the order 1/L.
  for (const double degrees : {1.0, 60.0, 120.0, 179.0}) {
    const std::vector<Polygon> faces = wedge(degrees, 1e4);
    const double expected = 1 - std::sin(degrees * std::numbers::pi / 360);
    CHECK(polygonToPolygon(faces[2], faces[4]) ==
          Approx(expected).margin(2e-4 * std::sin(degrees * std::numbers::pi / 180)));
  }
}

TEST_CASE("polygonToPolygon of the faces of any tetrahedron sums to 1", "[form factors]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const double flat : {1.0, 0.1, 1e-3})
    for (int i = 0; i < 3; ++i) {
      std::array<glm::dvec3, 4> corners;
      for (glm::dvec3& corner : corners) {
        const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
        corner = {x, y, flat * z};
      }
      CHECK(worstClosure(tetrahedron(corners)) < 1e-11);
    }
}

TEST_CASE("polygonToPolygon between faces of a regular tetrahedron is a third", "[form factors]") {
  const std::vector<Polygon> faces = tetrahedron({{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}});
  for (const Polygon& from : faces)
    for (const Polygon& to : faces)
      if (&from != &to) CHECK(relativeError(polygonToPolygon(from, to), 1.0 / 3) < 1e-13);
}

TEST_CASE("polygonToPolygon satisfies reciprocity", "[form factors]") {
  const Polygon triangle{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  const Polygon pentagon{{0, 0, 0.5}, {0, 1, 1}, {0.5, 2, 1.5}, {1, 1, 1}, {1, 0, 0.5}};
  for (const Polygon& to :
       {pentagon, moved(pentagon, glm::dmat3(1), {0, 0, -0.5}, 1), moved(pentagon, glm::dmat3(1), {0, 0, 100}, 1)}) {
    const double there = polygonToPolygon(triangle, to);
    CHECK(there > 0);
    CHECK(relativeError(areaOf(triangle) * there, areaOf(to) * polygonToPolygon(to, triangle)) < 1e-12);
  }
}

TEST_CASE("polygonToPolygon to a polygon is the sum of that to its parts", "[form factors]") {
  const Polygon floor = floorOf(rectangle(0, 1, 0, 1));
  const Polygon roof{{0, 1, 0.1}, {1, 1, 0.1}, {1, 0, 2}, {0, 0, 2}};
  const Polygon lower{roof[0], roof[1], roof[2]}, upper{roof[0], roof[2], roof[3]};
  CHECK(relativeError(polygonToPolygon(floor, lower) + polygonToPolygon(floor, upper), polygonToPolygon(floor, roof)) <
        1e-13);
}

TEST_CASE("polygonToPolygon counts only the parts in front of each other", "[form factors]") {
  // A wall that continues below the floor, and a floor that continues behind the wall. The parts in front have the
  // closed form, but the whole area of the floor counts.
  const Polygon floor = floorOf(rectangle(0, 1, -1, 1)), wall = wallOf(rectangle(0, 1, -3, 1));
  const double quarter = perpendicularRectangles(rectangle(0, 1, 0, 1), rectangle(0, 1, 0, 1));
  CHECK(relativeError(polygonToPolygon(floor, wall), quarter / 2) < 1e-12);
  CHECK(relativeError(polygonToPolygon(wall, floor), quarter / 4) < 1e-12);
}

TEST_CASE("polygonToPolygon is 0 for coplanar polygons, and for backs", "[form factors]") {
  const Polygon floor = floorOf(rectangle(0, 1, 0, 1)), ceiling = reversed(floorOf(rectangle(0, 1, 0, 1), 1));
  CHECK(polygonToPolygon(floor, ceiling) > 0);
  CHECK(polygonToPolygon(reversed(floor), ceiling) == 0);
  CHECK(polygonToPolygon(floor, reversed(ceiling)) == 0);
  CHECK(polygonToPolygon(floor, floorOf(rectangle(1, 2, 0, 1))) == 0);
  CHECK(polygonToPolygon(floor, floor) == 0);
}

TEST_CASE("polygonToPolygon is 0 between pieces of one plane, for any rounding of its slant", "[form factors]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  for (int i = 0; i < 100; ++i) {
    const double a = angle(random), b = angle(random);
    const glm::dmat3 aboutZ{{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1}};
    const glm::dmat3 aboutX{{1, 0, 0}, {0, std::cos(b), std::sin(b)}, {0, -std::sin(b), std::cos(b)}};
    const glm::dmat3 turn = aboutX * aboutZ;
    const glm::dvec3 by(std::cos(b), std::sin(a), a);
    const Polygon here = moved(floorOf(rectangle(0, 1, 0, 1)), turn, by, 1);
    for (const AxisRectangle& beside : {rectangle(1, 2, 0, 1), rectangle(1, 2, 1, 3), rectangle(4, 5, 0, 1)})
      CHECK(polygonToPolygon(here, moved(floorOf(beside), turn, by, 1)) == 0);
  }
}
