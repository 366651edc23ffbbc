// Form factors of axis-parallel rectangles, compared with the textbook formulas in 100 digits and with quadrature.
#include "tests/truth/rectangles.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/support/form_factor_quadrature.h"

using namespace hemitex::tests;

namespace {

using Digits100 = boost::multiprecision::cpp_bin_float_100;
const Digits100 pi = boost::math::constants::pi<Digits100>();

/// Howell C-11, as in the book: equal rectangles a x b opposite each other.
double bookParallel(double a, double b, double gap) {
  const Digits100 x = Digits100(a) / gap, y = Digits100(b) / gap;
  const Digits100 p = sqrt(1 + y * y), q = sqrt(1 + x * x);
  const Digits100 sum = log((1 + x * x) * (1 + y * y) / (1 + x * x + y * y)) / 2 + x * p * atan(x / p) +
                        y * q * atan(y / q) - x * atan(x) - y * atan(y);
  return static_cast<double>(2 / (pi * x * y) * sum);
}

/// Howell C-14, as in the book: from the rectangle of width `width` to that of height `height`, along a common edge.
double bookPerpendicular(double width, double height, double edge) {
  const Digits100 w = Digits100(width) / edge, h = Digits100(height) / edge;
  const Digits100 w2 = w * w, h2 = h * h, both = w2 + h2, root = sqrt(both);
  const Digits100 logarithms = log((1 + w2) * (1 + h2) / (1 + both)) + w2 * log(w2 * (1 + both) / ((1 + w2) * both)) +
                               h2 * log(h2 * (1 + both) / ((1 + h2) * both));
  const Digits100 sum = w * atan(1 / w) + h * atan(1 / h) - root * atan(1 / root) + logarithms / 4;
  return static_cast<double>(sum / (pi * w));
}

const std::vector<double> gaps{1e-6, 1e-4, 0.01, 0.3, 1, 7, 100, 3e3, 1e4};
const std::vector<double> widths{1, 0.3, 1e-3, 1e-6};
const std::vector<double> sizes{1, 1e-6, 1e6};

AxisRectangle rectangle(double x0, double x1, double y0, double y1) { return {{x0, x1}, {y0, y1}}; }

double rectangleArea(const AxisRectangle& r) { return (r.first.high - r.first.low) * (r.second.high - r.second.low); }

Parallelogram floorOf(const AxisRectangle& r) {
  return {{r.first.low, r.second.low, 0}, {r.first.high - r.first.low, 0, 0}, {0, r.second.high - r.second.low, 0}};
}

Parallelogram ceilingOf(const AxisRectangle& r, double z) {
  Parallelogram ceiling = floorOf(r).reversed();
  ceiling.corner.z = z;
  return ceiling;
}

/// In the plane y = `y`, facing along y (or, reversed, against it).
Parallelogram wallOf(const AxisRectangle& r, double y) {
  return {{r.first.low, y, r.second.low}, {0, 0, r.second.high - r.second.low}, {r.first.high - r.first.low, 0, 0}};
}

/// Pairs of different sizes without a common edge, far enough apart for the quadrature.
const std::vector<std::array<AxisRectangle, 2>> unequalPairs{
    {rectangle(0, 1, 0, 1), rectangle(-1, 0.5, 0.25, 1)},
    {rectangle(0, 1, 0.5, 1), rectangle(2, 3, 1.25, 2)},
    {rectangle(-1, 1, 0.75, 1), rectangle(5, 5.125, 0.5, 0.75)},
    {rectangle(0, 1e-6, 0.5, 1), rectangle(3, 4, 0.5, 0.500001)},
};

}  // namespace

TEST_CASE("parallelRectangles of equal rectangles equals the book's form factor for all gaps, widths and scales",
          "[form factors]") {
  double worst = 0;
  for (const double gap : gaps)
    for (const double width : widths)
      for (const double scale : sizes) {
        const AxisRectangle r = rectangle(0, scale, 0, width * scale);
        worst = std::max(worst, relativeError(parallelRectangles(r, r, gap * scale),
                                              bookParallel(scale, width * scale, gap * scale)));
      }
  CHECK(worst < 1e-15);
}

TEST_CASE("perpendicularRectangles with a common edge equals the book's form factor for all widths, heights and scales",
          "[form factors]") {
  double worst = 0;
  for (const double width : gaps)
    for (const double height : gaps)
      for (const double scale : sizes)
        worst = std::max(worst, relativeError(perpendicularRectangles(rectangle(0, scale, 0, width * scale),
                                                                      rectangle(0, scale, 0, height * scale)),
                                              bookPerpendicular(width * scale, height * scale, scale)));
  CHECK(worst < 1e-15);
}

TEST_CASE("parallelRectangles and perpendicularRectangles of unequal rectangles equal quadrature", "[form factors]") {
  for (const auto& [from, to] : unequalPairs) {
    for (const double gap : {2.0, 10.0, 1e4})
      CHECK(relativeError(parallelRectangles(from, to, gap), bruteForce(floorOf(from), ceilingOf(to, gap))) < 1e-12);
  }
  // The wall is at y = 0, so these start at a small distance from it; the first pair would be too near for the
  // quadrature.
  for (std::size_t i = 1; i < unequalPairs.size(); ++i) {
    const auto& [from, to] = unequalPairs[i];
    CHECK(relativeError(perpendicularRectangles(from, to), bruteForce(floorOf(from), wallOf(to, 0))) < 1e-12);
  }
}

TEST_CASE("elementToParallelRectangle and elementToPerpendicularRectangle equal quadrature", "[form factors]") {
  const glm::dvec3 origin(0), up(0, 0, 1);
  for (const AxisRectangle& to : {rectangle(-0.5, 1, 0, 0.5), rectangle(2, 3, 0.5, 0.500001)})
    for (const double distance : {3.0, 1e4}) {
      CHECK(relativeError(elementToParallelRectangle(to, distance), bruteForce(origin, up, ceilingOf(to, distance))) <
            1e-12);
      CHECK(relativeError(elementToPerpendicularRectangle(to, distance),
                          bruteForce(origin, up, wallOf(to, distance).reversed())) < 1e-12);
    }
}

TEST_CASE("elementToParallelRectangle and elementToPerpendicularRectangle are the limits for small rectangles",
          "[form factors]") {
  // A square of side s about the point differs by terms in s^2: here by at most 1e-12 for gaps of 1 and more.
  const double s = 1e-6;
  const AxisRectangle to = rectangle(-0.5, 1, 0.25, 2), small = rectangle(-s / 2, s / 2, 1 - s / 2, 1 + s / 2);
  const AxisRectangle seen = rectangle(-0.5, 1, -0.75, 1);  // `to` seen from (0, 1)
  CHECK(relativeError(elementToParallelRectangle(seen, 1), parallelRectangles(small, to, 1)) < 1e-11);
  CHECK(relativeError(elementToPerpendicularRectangle(to, 1), perpendicularRectangles(small, to)) < 1e-11);
}

TEST_CASE("parallelRectangles and perpendicularRectangles satisfy reciprocity", "[form factors]") {
  for (const auto& [from, to] : unequalPairs) {
    for (const double gap : gaps)
      CHECK(relativeError(rectangleArea(from) * parallelRectangles(from, to, gap),
                          rectangleArea(to) * parallelRectangles(to, from, gap)) < 1e-15);
    CHECK(relativeError(rectangleArea(from) * perpendicularRectangles(from, to),
                        rectangleArea(to) * perpendicularRectangles(to, from)) < 1e-15);
  }
}

TEST_CASE("parallelRectangles and perpendicularRectangles to a rectangle are the sums of those to its parts",
          "[form factors]") {
  const AxisRectangle from = rectangle(0, 1, 0, 1), left = rectangle(-1, 0.3, 0, 2), right = rectangle(0.3, 1.5, 0, 2);
  const AxisRectangle whole = rectangle(-1, 1.5, 0, 2);
  for (const double gap : gaps)
    CHECK(relativeError(parallelRectangles(from, left, gap) + parallelRectangles(from, right, gap),
                        parallelRectangles(from, whole, gap)) < 1e-15);
  CHECK(relativeError(perpendicularRectangles(from, left) + perpendicularRectangles(from, right),
                      perpendicularRectangles(from, whole)) < 1e-15);
}

TEST_CASE("parallelRectangles and perpendicularRectangles from each face of a box sum to 1", "[form factors]") {
  for (const double width : {1.0, 1e-3, 1e-6, 1e4})
    for (const double height : {1.0, 1e-6, 1e4}) {
      // From the floor, 1 x width: the ceiling, and two walls along each of its sides.
      const AxisRectangle floor = rectangle(0, 1, 0, width), turned = rectangle(0, width, 0, 1);
      const double sum = parallelRectangles(floor, floor, height) +
                         2 * perpendicularRectangles(floor, rectangle(0, 1, 0, height)) +
                         2 * perpendicularRectangles(turned, rectangle(0, width, 0, height));
      CHECK(std::abs(sum - 1) < 1e-15);
    }
}

TEST_CASE("parallelRectangles and perpendicularRectangles far away equal area cos cos over pi times squared distance",
          "[form factors]") {
  // For squares of side 1 at a distance d, the point rule is accurate to terms in 1/d^2: here 1e-8.
  const AxisRectangle square = rectangle(0, 1, 0, 1), aside = rectangle(1e4, 1e4 + 1, 1e4, 1e4 + 1);
  CHECK(relativeError(parallelRectangles(square, square, 1e4), 1 / (std::numbers::pi * 1e8)) < 2e-8);
  // At a slant: r^2 = 3e8, both cosines 1/sqrt(3).
  CHECK(relativeError(parallelRectangles(square, aside, 1e4), 1.0 / 3 / (std::numbers::pi * 3e8)) < 2e-8);
}

TEST_CASE("parallelRectangles of plates that almost touch is 1", "[form factors]") {
  // The light lost at the gap's rim is below perimeter times gap over area.
  const AxisRectangle square = rectangle(0, 1, 0, 1);
  CHECK(parallelRectangles(square, square, 1e-12) < 1);
  CHECK(parallelRectangles(square, square, 1e-12) > 1 - 4e-12);
}
