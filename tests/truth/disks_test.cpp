// Form factors to disks, compared with the textbook formulas in 100 digits and with quadrature.
#include "tests/truth/disks.h"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "tests/support/form_factor_quadrature.h"

using namespace hemitex::tests;

namespace {

using Digits100 = boost::multiprecision::cpp_bin_float_100;

const std::vector<double> lengths{1e-6, 1e-3, 0.1, 0.5, 1, 1.5, 10, 1e3, 1e4};
const std::vector<double> scales{1, 1e-6, 1e6};

/// Howell C-41, as in the book.
double bookCoaxial(const Digits100& from, const Digits100& to, const Digits100& gap) {
  const Digits100 r1 = from / gap, r2 = to / gap, s = 1 + (1 + r2 * r2) / (r1 * r1);
  return static_cast<double>((s - sqrt(s * s - 4 * (to / from) * (to / from))) / 2);
}

/// The book's formulas for elements, in H = gap/offset, R = radius/offset, Z = 1 + H^2 + R^2.
double bookParallel(const Digits100& radius, const Digits100& gap, const Digits100& offset) {
  const Digits100 h = gap / offset, r = radius / offset, z = 1 + h * h + r * r;
  return static_cast<double>((1 - (z - 2 * r * r) / sqrt(z * z - 4 * r * r)) / 2);
}

double bookPerpendicular(const Digits100& radius, const Digits100& gap, const Digits100& offset) {
  const Digits100 h = gap / offset, r = radius / offset, z = 1 + h * h + r * r;
  return static_cast<double>(h / 2 * (z / sqrt(z * z - 4 * r * r) - 1));
}

/// cos cos / (pi r^2) over a disk in the plane z = gap, from the origin, with the disk's axis at x = offset. Gauss'
/// rule along the radius, and 64 equal steps around, which is as accurate for a periodic function.
double bruteForceDisk(const glm::dvec3& normal, double radius, double gap, double offset) {
  return boost::math::quadrature::gauss<double, 20>::integrate(
      [&](double distance) {
        double sum = 0;
        for (int i = 0; i < 64; ++i) {
          const double angle = 2 * std::numbers::pi * i / 64;
          const glm::dvec3 r(offset + distance * std::cos(angle), distance * std::sin(angle), gap);
          sum += glm::dot(normal, r) * gap / (std::numbers::pi * glm::dot(r, r) * glm::dot(r, r));
        }
        return sum * distance * 2 * std::numbers::pi / 64;
      },
      0.0, radius);
}

}  // namespace

TEST_CASE("coaxialDisks equals the book's form factor for all radii, gaps and scales", "[form factors]") {
  double worst = 0;
  for (const double from : lengths)
    for (const double to : lengths)
      for (const double gap : lengths)
        for (const double scale : scales)
          worst = std::max(worst, relativeError(coaxialDisks(from * scale, to * scale, gap * scale),
                                                bookCoaxial(from * scale, to * scale, gap * scale)));
  CHECK(worst < 1e-14);
}

TEST_CASE(
    "elementToParallelDisk and elementToPerpendicularDisk equal the book's form factors for all radii, gaps, offsets "
    "and scales",
    "[form factors]") {
  double worstParallel = 0, worstPerpendicular = 0;
  for (const double radius : lengths)
    for (const double gap : lengths)
      for (const double offset : lengths)
        for (const double scale : scales) {
          const double r = radius * scale, g = gap * scale, o = offset * scale;
          worstParallel = std::max(worstParallel, relativeError(elementToParallelDisk(r, g, o), bookParallel(r, g, o)));
          if (offset >= radius)
            worstPerpendicular = std::max(
                worstPerpendicular, relativeError(elementToPerpendicularDisk(r, g, o), bookPerpendicular(r, g, o)));
        }
  CHECK(worstParallel < 1e-14);
  CHECK(worstPerpendicular < 1e-14);
}

TEST_CASE("elementToParallelDisk and elementToPerpendicularDisk equal quadrature", "[form factors]") {
  for (const double radius : {0.5, 1.0})
    for (const double offset : {1.0, 3.0}) {
      const double gap = 2;
      CHECK(relativeError(elementToParallelDisk(radius, gap, offset), bruteForceDisk({0, 0, 1}, radius, gap, offset)) <
            1e-12);
      CHECK(relativeError(elementToPerpendicularDisk(radius, gap, offset),
                          bruteForceDisk({1, 0, 0}, radius, gap, offset)) < 1e-12);
    }
}

TEST_CASE("coaxialDisks is the mean of elementToParallelDisk over the points of one disk", "[form factors]") {
  for (const double gap : {1.0, 1e4}) {
    const double from = 1, to = 2;
    const auto ring = [&](double offset) { return 2 * offset * elementToParallelDisk(to, gap, offset); };
    const double mean = boost::math::quadrature::gauss<double, 30>::integrate(ring, 0.0, from) / (from * from);
    CHECK(relativeError(coaxialDisks(from, to, gap), mean) < 1e-12);
  }
}

TEST_CASE("coaxialDisks satisfies reciprocity", "[form factors]") {
  for (const double from : lengths)
    for (const double to : lengths)
      CHECK(relativeError(from * from * coaxialDisks(from, to, 0.7), to * to * coaxialDisks(to, from, 0.7)) < 1e-14);
}

TEST_CASE("elementToParallelDisk on the axis is the squared sine of the half angle", "[form factors]") {
  for (const double gap : lengths) CHECK(relativeError(elementToParallelDisk(1, gap, 0), 1 / (1 + gap * gap)) < 1e-14);
}
