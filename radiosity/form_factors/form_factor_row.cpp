#include "radiosity/form_factors/form_factor_row.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace hemitex::radiosity {
namespace {

/// A row whose shares are not yet rounded to integers.
struct Sums {
  std::vector<std::uint32_t> elements;  ///< ascending
  std::vector<double> shares;
  double background = 0, back = 0;
};

/// Adds sparse rows by merging their ascending lists of elements.
Sums sum(const Sums& sums, const FormFactorRow& row, double weight) {
  Sums result{{},
              {},
              sums.background + weight * static_cast<double>(row.background),
              sums.back + weight * static_cast<double>(row.back)};
  result.elements.reserve(sums.elements.size() + row.elements.size());
  result.shares.reserve(sums.elements.size() + row.elements.size());
  std::size_t i = 0, j = 0;
  while (i < sums.elements.size() || j < row.elements.size()) {
    const bool fromSums = j == row.elements.size() || (i < sums.elements.size() && sums.elements[i] <= row.elements[j]);
    const bool fromRow = i == sums.elements.size() || (j < row.elements.size() && row.elements[j] <= sums.elements[i]);
    result.elements.push_back(fromSums ? sums.elements[i] : row.elements[j]);
    double share = 0;
    if (fromSums) share += sums.shares[i++];
    if (fromRow) share += weight * static_cast<double>(row.shares[j++]);
    result.shares.push_back(share);
  }
  return result;
}

std::uint64_t rounded(double share) { return static_cast<std::uint64_t>(std::nearbyint(share)); }

std::uint64_t totalOf(const FormFactorRow& row) {
  return std::accumulate(row.shares.begin(), row.shares.end(), row.background + row.back);
}

/// Adds the difference to `total` to the largest share, which is far larger than the difference.
void close(FormFactorRow& row, std::uint64_t total) {
  std::uint64_t* largest = row.background > row.back ? &row.background : &row.back;
  for (std::uint64_t& share : row.shares)
    if (share > *largest) largest = &share;
  *largest += total - totalOf(row);
}

/// Rounds shares to integers that sum to `total`.
FormFactorRow roundedRow(const Sums& sums, std::uint64_t total) {
  FormFactorRow result{{}, {}, rounded(sums.background), rounded(sums.back)};
  result.elements.reserve(sums.elements.size());
  result.shares.reserve(sums.elements.size());
  for (std::size_t i = 0; i < sums.shares.size(); ++i) {
    if (rounded(sums.shares[i]) == 0) continue;
    result.elements.push_back(sums.elements[i]);
    result.shares.push_back(rounded(sums.shares[i]));
  }
  close(result, total);
  return result;
}

FormFactorRow weightedSum(std::span<const WeightedRow> rows, double area, std::uint64_t total) {
  Sums sums;
  for (const WeightedRow& weighted : rows) sums = sum(sums, weighted.row, weighted.area / area);
  return roundedRow(sums, total);
}

}  // namespace

FormFactorRow meanOf(std::span<const WeightedRow> rows) {
  assert(!rows.empty());
  const double area = std::accumulate(rows.begin(), rows.end(), 0.0,
                                      [](double sum, const WeightedRow& weighted) { return sum + weighted.area; });
  return weightedSum(rows, area, wholeShare);
}

FormFactorRow closedRow(const std::vector<std::uint32_t>& elements, const std::vector<double>& shares,
                        double background, double back) {
  const double total = std::accumulate(shares.begin(), shares.end(), background + back);
  const double scale = static_cast<double>(wholeShare) / total;
  Sums sums{elements, shares, scale * background, scale * back};
  for (double& share : sums.shares) share *= scale;
  return roundedRow(sums, wholeShare);
}

FormFactorRow partOfMean(std::span<const WeightedRow> parts, double area) {
  double total = 0;
  for (const WeightedRow& part : parts) total += part.area / area * static_cast<double>(totalOf(part.row));
  return weightedSum(parts, area, rounded(total));
}

FormFactorRow exchanged(const FormFactorRow& row, const FormFactorRow& less, const FormFactorRow& more) {
  assert(less.background <= row.background + more.background && less.back <= row.back + more.back);
  FormFactorRow result{{}, {}, row.background - less.background + more.background, row.back - less.back + more.back};
  std::size_t i = 0, j = 0, k = 0;
  const auto elementAt = [](const FormFactorRow& some, std::size_t index) {
    return index < some.elements.size() ? some.elements[index] : std::numeric_limits<std::uint32_t>::max();
  };
  const auto shareOf = [&](const FormFactorRow& some, std::size_t& index, std::uint32_t element) {
    return elementAt(some, index) == element ? some.shares[index++] : 0;
  };
  while (i < row.elements.size() || j < less.elements.size() || k < more.elements.size()) {
    const std::uint32_t element = std::min({elementAt(row, i), elementAt(less, j), elementAt(more, k)});
    const std::uint64_t had = shareOf(row, i, element), loses = shareOf(less, j, element);
    assert(loses <= had);
    const std::uint64_t share = had - loses + shareOf(more, k, element);
    if (share == 0) continue;
    result.elements.push_back(element);
    result.shares.push_back(share);
  }
  return result;
}

}  // namespace hemitex::radiosity
