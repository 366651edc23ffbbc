/// quickFormFactor against polygonToPolygon, whose relative error is 1e-9.
#include "reference/truth/closed_forms/quick_form_factor.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "reference/truth/closed_forms/polygon_to_polygon.h"

using namespace hemitex::reference;

namespace {

using TriangleCorners = std::array<glm::dvec3, 3>;

/// A random triangle of about this size around a point.
TriangleCorners randomTriangle(std::mt19937& random, const glm::dvec3& middle, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  TriangleCorners triangle;
  for (glm::dvec3& corner : triangle) corner = middle + glm::dvec3(unit(random), unit(random), unit(random));
  return triangle;
}

}  // namespace

TEST_CASE("quickFormFactor of random triangles is that of polygonToPolygon within 1e-3", "[quick_form_factor]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> logarithm(-1.5, 1.5), unit(-1, 1);
  double worst = 0;
  int seen = 0;
  for (int n = 0; n < 3000; ++n) {
    const double distance = std::pow(10, logarithm(random)), size = std::pow(10, logarithm(random) / 2);
    const TriangleCorners from = randomTriangle(random, {0, 0, 0}, 1),
                          to = randomTriangle(random, distance * glm::dvec3(unit(random), unit(random), 1), size);
    const double exact = polygonToPolygon(from, to);
    if (exact < 1e-9) continue;
    ++seen;
    worst = std::max(worst, std::abs(quickFormFactor(from, to) / exact - 1));
  }
  CHECK(seen > 300);
  CHECK(worst < 1e-3);
}

TEST_CASE("quickFormFactor of touching triangles is the closed form within 1e-6", "[quick_form_factor]") {
  // Two triangles at a right angle with a common edge.
  const TriangleCorners floor{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}}, wall{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  CHECK(quickFormFactor(floor, wall) == Approx(polygonToPolygon(floor, wall)).epsilon(1e-6));
  CHECK(quickFormFactor(floor, wall) == Approx(quickFormFactor(wall, floor)).epsilon(1e-9));  // of equal areas
  CHECK(quickFormFactor(floor, floor) == 0);
}

TEST_CASE("quickFormFactor of long parallel strips tends to Hottel's crossed strings", "[quick_form_factor]") {
  for (const double length : {1e3, 1e5}) {
    for (const double gap : {0.05, 0.5, 2.0}) {
      CAPTURE(length, gap);
      using Strip = std::vector<glm::dvec3>;
      const Strip floor{{0, 0, 0}, {length, 0, 0}, {length, 1, 0}, {0, 1, 0}};
      const Strip roof{{0, 0, gap}, {0, 1, gap}, {length, 1, gap}, {length, 0, gap}};
      const double infinite = std::sqrt(1 + gap * gap) - gap;  // per width 1
      CHECK(quickFormFactor(floor, roof) == Approx(infinite).margin(5 * gap / length));
      CHECK(quickFormFactor(floor, roof) == Approx(polygonToPolygon(floor, roof)).epsilon(1e-6));
      // Turned, so that no coordinate is exact.
      const glm::dmat3 turn(glm::normalize(glm::dvec3(1, 2, 3)), glm::normalize(glm::dvec3(3, 0, -1)),
                            glm::cross(glm::normalize(glm::dvec3(1, 2, 3)), glm::normalize(glm::dvec3(3, 0, -1))));
      Strip turnedFloor = floor, turnedRoof = roof;
      for (Strip* strip : {&turnedFloor, &turnedRoof})
        for (glm::dvec3& corner : *strip) corner = turn * corner;
      CHECK(quickFormFactor(turnedFloor, turnedRoof) == Approx(quickFormFactor(floor, roof)).epsilon(2e-6));
    }
  }
}
