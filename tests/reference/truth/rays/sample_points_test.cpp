// SamplePoints: each block is a net, all blocks are one, and the standard error is that of a mean.
#include "reference/truth/rays/sample_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

using namespace hemitex::reference;

namespace {

/// Whether each of the 2^-a x 2^-(m - a) boxes has one of the 2^m points in its first two coordinates, for all a, and
/// each interval of 2^-m has one in each coordinate.
bool isNet(const std::vector<SamplePoint>& points, int m) {
  const auto cellsAreFull = [&](const auto& cellOf) {
    std::vector<bool> isFull(points.size());
    for (const SamplePoint& p : points) isFull[static_cast<std::size_t>(cellOf(p))] = true;
    return std::find(isFull.begin(), isFull.end(), false) == isFull.end();
  };
  bool result = points.size() == std::size_t{1} << m;
  for (int a = 0; a <= m; ++a)
    result &= cellsAreFull(
        [&](const SamplePoint& p) { return int(p[0] * (1 << a)) * (1 << (m - a)) + int(p[1] * (1 << (m - a))); });
  for (std::size_t axis = 0; axis < 4; ++axis)
    result &= cellsAreFull([&](const SamplePoint& p) { return int(p[axis] * (1 << m)); });
  return result;
}

std::vector<SamplePoint> blockOf(const SamplePoints& points, std::size_t block) {
  std::vector<SamplePoint> list;
  for (std::size_t i = 0; i < points.count(); ++i) list.push_back(points.at(block, i));
  return list;
}

}  // namespace

TEST_CASE("SamplePoints of 2^m points per block are nets, in each block and in all blocks together", "[samples]") {
  // Sobol's first two coordinates are a (0, m, 2)-net in base 2, and a digital shift preserves that. Each of the four
  // coordinates is a net by itself.
  for (const int m : {0, 1, 10}) {
    const SamplePoints points(std::size_t{1} << m, 7);
    std::vector<SamplePoint> all;
    for (std::size_t block = 0; block < sampleBlocks; ++block) {
      const std::vector<SamplePoint> own = blockOf(points, block);
      CHECK(isNet(own, m));
      all.insert(all.end(), own.begin(), own.end());
    }
    CHECK(isNet(all, m + 5));  // 32 blocks
  }
}

TEST_CASE("SamplePoints of a number that is no power of two have different points in all blocks", "[samples]") {
  const SamplePoints points(11, 0);
  std::set<SamplePoint> all;
  for (std::size_t block = 0; block < sampleBlocks; ++block)
    for (const SamplePoint& point : blockOf(points, block)) all.insert(point);
  CHECK(all.size() == 11 * sampleBlocks);
}

TEST_CASE("SamplePoints have different points for all blocks and seeds", "[samples]") {
  std::set<SamplePoint> first;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const SamplePoints points(1, seed);
    for (std::size_t block = 0; block < sampleBlocks; ++block) {
      const SamplePoint point = points.at(block, 0);
      first.insert(point);
      for (const double coordinate : point) CHECK((coordinate > 0 && coordinate < 1));
    }
  }
  CHECK(first.size() == 100 * sampleBlocks);
}

TEST_CASE("meanOf gives the standard error of the mean", "[samples]") {
  // Of 1, 2, 3, 4: variance 5/3, over four values.
  const Measurement mean = meanOf(std::vector<double>{1, 2, 3, 4});
  CHECK(mean.value == 2.5);
  CHECK(mean.standardError == Approx(std::sqrt(5.0 / 12)).epsilon(1e-15));
  CHECK(meanOf(std::vector<double>{0.1, 0.1, 0.1}).standardError < 1e-16);
}
