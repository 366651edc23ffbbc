#include "radiosity/form_factors/form_factor_row.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

using namespace hemitex::radiosity;

namespace {

std::uint64_t total(const FormFactorRow& row) {
  return std::accumulate(row.shares.begin(), row.shares.end(), row.background + row.back);
}

/// A row over some of `elements` elements, closed by the background.
FormFactorRow randomRow(std::mt19937& random, std::uint32_t elements) {
  FormFactorRow row;
  for (std::uint32_t element = 0; element < elements; ++element) {
    if (random() % 3 == 0) continue;
    row.elements.push_back(element);
    row.shares.push_back(1 + (std::uint64_t{random()} << 20));
  }
  row.back = std::uint64_t{random()} << 15;
  row.background = wholeShare - total(row);
  return row;
}

}  // namespace

TEST_CASE("meanOf weights rows by area and loses no share", "[form_factors]") {
  std::mt19937 random(7);
  for (const std::size_t count : {1U, 2U, 5U, 64U}) {
    std::vector<WeightedRow> rows;
    double area = 0;
    for (std::size_t i = 0; i < count; ++i) {
      rows.push_back({randomRow(random, 40), 0.1 + static_cast<double>(random() % 1000)});
      area += rows.back().area;
    }
    const FormFactorRow mean = meanOf(rows);
    CHECK(total(mean) == wholeShare);
    CHECK(std::is_sorted(mean.elements.begin(), mean.elements.end()));
    for (std::uint32_t element = 0; element < 40; ++element) {
      double expected = 0;
      for (const WeightedRow& weighted : rows) {
        const auto& seen = weighted.row.elements;
        const auto found = std::find(seen.begin(), seen.end(), element);
        if (found != seen.end())
          expected +=
              weighted.area / area * formFactor(weighted.row.shares[static_cast<std::size_t>(found - seen.begin())]);
      }
      const auto found = std::find(mean.elements.begin(), mean.elements.end(), element);
      const double share = found == mean.elements.end()
                               ? 0
                               : formFactor(mean.shares[static_cast<std::size_t>(found - mean.elements.begin())]);
      // Each sum has about `count` roundings of numbers up to 1.
      CHECK(std::abs(share - expected) <= static_cast<double>(count + 2) * 0x1p-53);
    }
  }
}

TEST_CASE("meanOf equal rows is that row, bit for bit", "[form_factors]") {
  // Weights of a half and a quarter change no bit of a share below 2^53 units. Larger shares are rounded to 2^-53, and
  // the largest share, the background, takes the difference.
  FormFactorRow row{{3, 5, 8}, {1, std::uint64_t{1} << 40, (std::uint64_t{1} << 52) + 1}, 0, 12345};
  row.background = wholeShare - total(row);
  const std::vector<WeightedRow> rows{{row, 2}, {row, 1}, {row, 1}};
  const FormFactorRow mean = meanOf(rows);
  CHECK(mean.elements == row.elements);
  CHECK(mean.shares == row.shares);
  CHECK(mean.background == row.background);
  CHECK(mean.back == row.back);
}

TEST_CASE("meanOf leaves out a share that rounds to zero", "[form_factors]") {
  // A unit of 2^-60 from a thousandth of the area: its share is 0, and rows have no elements with a share of 0.
  const FormFactorRow faint{{4}, {1}, wholeShare - 1, 0}, nothing{{}, {}, wholeShare, 0};
  const std::vector<WeightedRow> rows{{faint, 1}, {nothing, 999}};
  const FormFactorRow mean = meanOf(rows);
  CHECK(mean.elements.empty());
  CHECK(mean.background == wholeShare);
}
