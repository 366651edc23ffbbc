// mergeSlivers: slivers merge, and phantoms map to the nearest element.
#include "radiosity/discretization/sliver_merging.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace hemitex::radiosity;
using Texels = std::vector<std::uint32_t>;

namespace {

/// The covered share of the group that maps to each own texel.
std::vector<double> groupCoverage(const Texels& merged, const std::vector<double>& coverage) {
  std::vector<double> sum(merged.size());
  for (std::size_t texel = 0; texel < merged.size(); ++texel) sum[merged[texel]] += coverage[texel];
  return sum;
}

}  // namespace

TEST_CASE("mergeSlivers keeps texels as elements of their own, down to exactly a quarter", "[slivers]") {
  CHECK(mergeSlivers(2, 2, {1, 0.5, 0.25, 0.25 * (1 - 1e-15)}) == Texels{0, 1, 2, 3});
}

TEST_CASE("mergeSlivers merges a sliver into its largest neighbour", "[slivers]") {
  CHECK(mergeSlivers(3, 1, {0.9, 0.1, 1}) == Texels{0, 2, 2});
  CHECK(mergeSlivers(3, 1, {1, 0.1, 1}) == Texels{0, 0, 2});  // of equals, the lowest
  // The larger neighbour across an edge, not the even larger one across a corner.
  CHECK(mergeSlivers(2, 2, {0.1, 0.5, 0.6, 1}) == Texels{2, 1, 2, 3});
  // With the 0.1 that merged into it, 0.5 is larger than 0.55.
  CHECK(mergeSlivers(4, 1, {0.1, 0.5, 0.2, 0.55}) == Texels{1, 1, 1, 3});
  // Across a corner if no neighbour across an edge has area.
  CHECK(mergeSlivers(2, 2, {0.1, 0, 0, 1}) == Texels{3, 3, 3, 3});
}

TEST_CASE("mergeSlivers merges slivers in ascending order until their group covers a quarter", "[slivers]") {
  // 0.05 joins 0.12; the two, 0.17, join 0.2 and are complete at 0.37. The own texel is that of 0.2.
  CHECK(mergeSlivers(4, 1, {0.05, 0.12, 0.2, 1}) == Texels{2, 2, 2, 3});
  CHECK(mergeSlivers(5, 1, {0.05, 0.12, 0.2, 0, 1}) == Texels{2, 2, 2, 2, 4});
  // 0.1 joins 0.2: at 0.3 they merge no further, although 0.2 has a completely covered neighbour.
  CHECK(mergeSlivers(4, 1, {0, 0.1, 0.2, 1}) == Texels{2, 2, 2, 3});
}

TEST_CASE("mergeSlivers keeps a sliver without neighbours as an element", "[slivers]") {
  CHECK(mergeSlivers(3, 3, {0, 0, 0, 0, 0.01, 0, 0, 0, 0}) == Texels(9, 4));
}

TEST_CASE("mergeSlivers merges a small group through any member with a neighbour outside", "[slivers]") {
  // 0.01 joins 0.06, the larger of its neighbours; 0.05 joins the whole texel; 0.06 finds only its own group of 0.07.
  // In the second round 0.01 connects both to the whole texel.
  CHECK(mergeSlivers(4, 1, {0.06, 0.01, 0.05, 1}) == Texels(4, 3));
}

TEST_CASE("mergeSlivers leaves no group below a quarter, unless no neighbour has area", "[slivers]") {
  std::mt19937 random(6);
  for (int trial = 0; trial < 400; ++trial) {
    const int columns = 1 + int(random() % 20), rows = 1 + int(random() % 20);
    std::vector<double> coverage(std::size_t(columns * rows));
    for (double& c : coverage) c = random() % 3 == 0 ? 0 : std::pow(10.0, -4 * double(random()) / 4294967296.0);
    coverage[random() % coverage.size()] = 0.5;
    const Texels merged = mergeSlivers(columns, rows, coverage);
    const std::vector<double> groups = groupCoverage(merged, coverage);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const auto texel = std::size_t(row * columns + column);
        // The map leads to an own texel, which has the largest coverage of its group.
        REQUIRE(merged[merged[texel]] == merged[texel]);
        REQUIRE(coverage[merged[texel]] >= coverage[texel] * (coverage[texel] > 0 ? 1 : 0));
        REQUIRE(coverage[merged[texel]] > 0);
        if (coverage[texel] == 0 || groups[merged[texel]] >= sliverCoverage - 1e-9) continue;
        for (int j = std::max(0, row - 1); j <= std::min(rows - 1, row + 1); ++j)
          for (int i = std::max(0, column - 1); i <= std::min(columns - 1, column + 1); ++i) {
            const auto neighbour = std::size_t(j * columns + i);
            REQUIRE((coverage[neighbour] == 0 || merged[neighbour] == merged[texel]));
          }
      }
  }
}

TEST_CASE("mergeSlivers maps a texel without area to the element of the nearest covered texel", "[slivers]") {
  // The first row is phantom, phantom, 0.1; the second row is 1, 0.5, phantom. The nearest texel of texel 0 is texel 3
  // (distance 1). For texel 1 it is texel 4 or 2 (distance 1). The lower is 2, a sliver that merged into 4, across a
  // corner.
  CHECK(mergeSlivers(3, 2, {0, 0, 0.1, 1, 0.5, 0}) == Texels{3, 4, 4, 3, 4, 4});
}
