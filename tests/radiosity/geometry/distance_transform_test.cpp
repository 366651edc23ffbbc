// nearestCovered compared with a search of all texels.
#include "radiosity/geometry/distance_transform.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace hemitex::radiosity;

namespace {

/// The covered texel with the smallest squared distance; of equals, the lowest.
std::uint32_t searched(int columns, const std::vector<bool>& covered, std::uint32_t texel) {
  const auto squaredDistance = [&](std::size_t other) {
    const int dx = int(other) % columns - int(texel) % columns, dy = int(other) / columns - int(texel) / columns;
    return dx * dx + dy * dy;
  };
  std::size_t best = covered.size();
  for (std::size_t other = 0; other < covered.size(); ++other)
    if (covered[other] && (best == covered.size() || squaredDistance(other) < squaredDistance(best))) best = other;
  return std::uint32_t(best);
}

}  // namespace

TEST_CASE("nearestCovered finds the same texel as a search of all; of equals, the lowest", "[nearest]") {
  std::mt19937 random(5);
  const std::vector<std::array<int, 2>> sizes{{1, 1}, {1, 17}, {17, 1}, {8, 8}, {13, 31}, {32, 32}};
  for (const auto& [columns, rows] : sizes)
    for (const unsigned oneIn : {2u, 7u, 40u, 2000u})
      for (int trial = 0; trial < 20; ++trial) {
        std::vector<bool> covered(std::size_t(columns * rows));
        for (std::size_t texel = 0; texel < covered.size(); ++texel) covered[texel] = random() % oneIn == 0;
        covered[random() % covered.size()] = true;
        const std::vector<std::uint32_t> nearest = nearestCovered(columns, rows, covered);
        bool allAgree = true;
        for (std::uint32_t texel = 0; texel < covered.size(); ++texel)
          allAgree &= nearest[texel] == searched(columns, covered, texel);
        INFO(columns << " x " << rows << ", one in " << oneIn << " covered");
        CHECK(allAgree);
      }
}

TEST_CASE("nearestCovered resolves ties of symmetric neighbours to the lowest texel", "[nearest]") {
  // A frame of covered texels around 5 x 5: the middle is equally far from all four sides.
  std::vector<bool> covered(25);
  for (int i = 0; i < 5; ++i) covered[std::size_t(i)] = covered[std::size_t(20 + i)] = true;
  for (int j = 0; j < 5; ++j) covered[std::size_t(5 * j)] = covered[std::size_t(5 * j + 4)] = true;
  const std::vector<std::uint32_t> nearest = nearestCovered(5, 5, covered);
  CHECK(nearest[12] == 2);
  CHECK(nearest[6] == 1);
  CHECK(nearest[18] == 19);
}

TEST_CASE("nearestCovered finds one covered texel in the corner of the largest grids", "[nearest]") {
  const int columns = GENERATE(4096, 64, longestGridSide), rows = mostGridTexels / columns;
  std::vector<bool> covered(mostGridTexels);
  covered.back() = true;
  const std::vector<std::uint32_t> nearest = nearestCovered(columns, rows, covered);
  CHECK(std::all_of(nearest.begin(), nearest.end(), [](std::uint32_t n) { return n == mostGridTexels - 1; }));
}

TEST_CASE("nearestCovered compares the distances of the longest grids exactly", "[nearest]") {
  // Two columns are covered in different rows; the border between them is where the distances are equal.
  constexpr int rows = mostGridTexels / longestGridSide;
  std::vector<bool> covered(mostGridTexels);
  covered[0] = covered.back() = true;
  const std::vector<std::uint32_t> nearest = nearestCovered(longestGridSide, rows, covered);
  for (int row = 0; row < rows; ++row)
    for (int column = longestGridSide / 2 - 100; column < longestGridSide / 2 + 100; ++column) {
      const std::int64_t toFirst = std::int64_t{column} * column + row * row, right = longestGridSide - 1 - column,
                         above = rows - 1 - row;
      CHECK((nearest[std::size_t(row) * longestGridSide + std::size_t(column)] == 0) ==
            (toFirst <= right * right + above * above));
    }
}
