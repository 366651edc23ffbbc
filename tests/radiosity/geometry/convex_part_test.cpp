/// inFrontOf and fromPoint against closed forms of rectangles.
#include "radiosity/geometry/convex_part.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace hemitex::radiosity;

namespace {

/// From a point to a parallel rectangle of a x b at distance 1, a corner of which is over the point (Howell, C-11).
double overCorner(double a, double b) {
  const double x = std::sqrt(1 + a * a), y = std::sqrt(1 + b * b);
  return 0.5 * std::numbers::inv_pi * (a / x * std::atan(b / x) + b / y * std::atan(a / y));
}

}  // namespace

TEST_CASE("fromPoint of a rectangle over a corner is the closed form", "[convex_part]") {
  for (const double a : {0.1, 1.0, 7.0})
    for (const double b : {0.3, 2.0}) {
      const glm::dvec3 up(0, 0, 1), corners[4]{{0, 0, 1}, {0, b, 1}, {a, b, 1}, {a, 0, 1}};
      double sum = 0;
      for (const std::size_t k : {1, 2})
        sum += fromPoint({0, 0, 0}, up, inFrontOf({corners[0], corners[k], corners[k + 1]}, {0, 0, 0}, up));
      CHECK(sum == Approx(overCorner(a, b)).epsilon(1e-12));
    }
}

TEST_CASE("inFrontOf keeps the part above the horizon, with which fromPoint of a wall is half of all",
          "[convex_part]") {
  const double far = 1e6;
  const glm::dvec3 up(0, 0, 1), corners[4]{{1, -far, -far}, {1, -far, far}, {1, far, far}, {1, far, -far}};
  double sum = 0;
  for (const std::size_t k : {1, 2})
    sum += fromPoint({0, 0, 0}, up, inFrontOf({corners[0], corners[k], corners[k + 1]}, {0, 0, 0}, up));
  CHECK(sum == Approx(0.5).epsilon(1e-5));
  CHECK(inFrontOf({glm::dvec3(0, 0, -1), {1, 0, -1}, {0, 1, -2}}, {0, 0, 0}, up).count == 0);
}
