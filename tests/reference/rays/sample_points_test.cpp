// SamplePoints: each randomization is a net, and the standard error is that of a mean.
#include "reference/rays/sample_points.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

using namespace hemitex::reference;

TEST_CASE("SamplePoints of 2^m points have one in each of the 2^m boxes of any shape, for each randomization",
          "[samples]") {
  // Sobol's first two coordinates are a (0, m, 2)-net in base 2, for all boxes 2^-a x 2^-(m - a), and a digital shift
  // preserves that. Each of the four coordinates is a net by itself.
  constexpr int m = 10;
  const SamplePoints points(1 << m, 7);
  for (std::size_t r = 0; r < randomizations; ++r) {
    bool isNet = true;
    for (int a = 0; a <= m; ++a) {
      std::set<int> boxes;
      for (std::size_t i = 0; i < points.count(); ++i) {
        const SamplePoint p = points.at(r, i);
        boxes.insert(int(p[0] * (1 << a)) * (1 << (m - a)) + int(p[1] * (1 << (m - a))));
      }
      isNet &= boxes.size() == points.count();
    }
    for (std::size_t axis = 0; axis < 4; ++axis) {
      std::set<int> intervals;
      for (std::size_t i = 0; i < points.count(); ++i) intervals.insert(int(points.at(r, i)[axis] * (1 << m)));
      isNet &= intervals.size() == points.count();
    }
    CHECK(isNet);
  }
}

TEST_CASE("SamplePoints have different shifts for all randomizations and seeds", "[samples]") {
  std::set<SamplePoint> first;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const SamplePoints points(1, seed);
    for (std::size_t r = 0; r < randomizations; ++r) {
      const SamplePoint point = points.at(r, 0);
      first.insert(point);
      for (const double coordinate : point) CHECK((coordinate > 0 && coordinate < 1));
    }
  }
  CHECK(first.size() == 100 * randomizations);
}

TEST_CASE("meanOf gives the standard error of the mean", "[samples]") {
  // Of 1, 2, 3, 4: variance 5/3, over four values.
  const Measurement mean = meanOf(std::vector<double>{1, 2, 3, 4});
  CHECK(mean.value == 2.5);
  CHECK(mean.standardError == Approx(std::sqrt(5.0 / 12)).epsilon(1e-15));
  CHECK(meanOf(std::vector<double>{0.1, 0.1, 0.1}).standardError < 1e-16);
}
