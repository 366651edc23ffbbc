/// quickFormFactor against polygonToPolygon, whose relative error is 1e-9.
#include "reference/truth/closed_forms/quick_form_factor.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "reference/truth/closed_forms/polygon_to_polygon.h"

using namespace hemitex::reference;

namespace {

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

TEST_CASE("quickFormFactor of touching triangles is the closed form itself", "[quick_form_factor]") {
  // Two triangles at a right angle with a common edge.
  const TriangleCorners floor{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}}, wall{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  CHECK(quickFormFactor(floor, wall) == polygonToPolygon(floor, wall));
  CHECK(quickFormFactor(floor, wall) == Approx(quickFormFactor(wall, floor)).epsilon(1e-9));  // of equal areas
  CHECK(quickFormFactor(floor, floor) == 0);
}
