#include "reference/matrices/facet_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "raster/base/parallel.h"

namespace hemitex::reference {
namespace {

using Order = std::vector<std::uint32_t>;
/// How badly a facet of the truth and one of the given matrix fit.
using Costs = FormFactorMatrix;

constexpr std::size_t largestEntries = 16;  ///< of a row and of a column, by which facets are first matched

FormFactorMatrix transposed(const FormFactorMatrix& matrix) {
  FormFactorMatrix result{matrix.size, std::vector<double>(matrix.factors.size())};
  for (std::size_t i = 0; i < matrix.size; ++i)
    for (std::size_t j = 0; j < matrix.size; ++j) result.factors[j * matrix.size + i] = matrix.at(i, j);
  return result;
}

/// The sum and the largest factors of each row, sorted.
std::vector<std::vector<double>> rowsSorted(const FormFactorMatrix& matrix) {
  std::vector<std::vector<double>> result(matrix.size);
  raster::parallelFor(matrix.size, [&](std::size_t r) {
    const auto begin = matrix.factors.begin() + static_cast<std::ptrdiff_t>(r * matrix.size);
    std::vector<double> row(begin, begin + static_cast<std::ptrdiff_t>(matrix.size));
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    const auto middle = row.begin() + static_cast<std::ptrdiff_t>(std::min(largestEntries, row.size()));
    std::partial_sort(row.begin(), middle, row.end(), std::greater<>());
    row.erase(middle, row.end());
    row.push_back(sum);
    result[r] = std::move(row);
  });
  return result;
}

/// Adds the differences of sorted rows to the costs.
void addSorted(Costs& costs, const FormFactorMatrix& given, const FormFactorMatrix& truth) {
  const auto ofGiven = rowsSorted(given), ofTruth = rowsSorted(truth);
  raster::parallelFor(costs.size, [&](std::size_t i) {
    for (std::size_t p = 0; p < costs.size; ++p)
      for (std::size_t k = 0; k < ofTruth[i].size(); ++k)
        costs.factors[i * costs.size + p] += std::abs(ofTruth[i][k] - ofGiven[p][k]);
  });
}

/// The facets, those of the smallest keys first.
std::vector<std::uint32_t> ascending(const std::vector<double>& keys) {
  std::vector<std::uint32_t> facets(keys.size());
  std::iota(facets.begin(), facets.end(), 0U);
  std::stable_sort(facets.begin(), facets.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
  return facets;
}

/// Gives each facet the free one of the smallest cost, the most certain facets first.
Order assigned(const Costs& costs) {
  const std::size_t size = costs.size;
  const auto row = [&](std::size_t i) { return costs.factors.begin() + static_cast<std::ptrdiff_t>(i * size); };
  std::vector<double> smallest(size);
  for (std::size_t i = 0; i < size; ++i)
    smallest[i] = *std::min_element(row(i), row(i) + static_cast<std::ptrdiff_t>(size));
  Order order(size);
  std::vector<bool> isTaken(size);
  for (const std::uint32_t i : ascending(smallest)) {
    std::size_t best = size;
    for (std::size_t p = 0; p < size; ++p)
      if (!isTaken[p] && (best == size || costs.at(i, p) < costs.at(i, best))) best = p;
    isTaken[best] = true;
    order[i] = static_cast<std::uint32_t>(best);
  }
  return order;
}

/// A matrix and its transposed one, so that columns are read as fast as rows.
struct BothWays {
  const FormFactorMatrix& rows;
  FormFactorMatrix columns = transposed(rows);
};

/// Adds to the costs how factors from and to the facets of `known` differ, which are matched by `order`.
Costs withKnown(Costs costs, const BothWays& given, const BothWays& truth, const Order& order,
                const std::vector<std::uint32_t>& known) {
  const std::size_t size = costs.size;
  raster::parallelFor(size, [&](std::size_t i) {
    for (const std::uint32_t k : known)
      for (std::size_t p = 0; p < size; ++p)
        costs.factors[i * size + p] += std::abs(truth.columns.at(k, i) - given.columns.at(order[k], p)) +
                                       std::abs(truth.rows.at(k, i) - given.rows.at(order[k], p));
  });
  return costs;
}

/// The sum of the differences in an order, over the sum of the truth.
double difference(const FormFactorMatrix& given, const FormFactorMatrix& truth, const Order& order) {
  double apart = 0, sum = 0;
  for (std::size_t i = 0; i < truth.size; ++i)
    for (std::size_t j = 0; j < truth.size; ++j) {
      apart += std::abs(truth.at(i, j) - given.at(order[i], order[j]));
      sum += truth.at(i, j);
    }
  return sum > 0 ? apart / sum : 0;
}

}  // namespace

std::optional<Order> facetOrder(const FormFactorMatrix& given, const FormFactorMatrix& truth) {
  constexpr int maxTries = 12, maxRounds = 6;
  constexpr std::size_t maxKnown = 64;
  constexpr double enough = 0.25;
  const std::size_t size = truth.size;
  const BothWays ofGiven{given}, ofTruth{truth};
  Costs alone{size, std::vector<double>(size * size, 0.0)};
  addSorted(alone, given, truth);
  addSorted(alone, ofGiven.columns, ofTruth.columns);

  // Facets that exchange the most say the most of others.
  std::vector<double> exchange(size);  // below 0, so that the largest come first
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) exchange[i] -= truth.at(i, j) + truth.at(j, i);
  std::vector<std::uint32_t> known = ascending(exchange);
  const std::uint32_t first = known.front();
  known.resize(std::min(size, maxKnown));

  const auto ofFirst = alone.factors.begin() + static_cast<std::ptrdiff_t>(first * size);
  std::vector<std::uint32_t> candidates = ascending({ofFirst, ofFirst + static_cast<std::ptrdiff_t>(size)});
  candidates.resize(std::min<std::size_t>(size, maxTries));
  Order best;
  double smallest = enough;
  for (const std::uint32_t candidate : candidates) {
    Order order(size);
    order[first] = candidate;
    Costs ofPair = withKnown(alone, ofGiven, ofTruth, order, std::vector<std::uint32_t>(4, first));
    for (std::size_t p = 0; p < size; ++p)
      ofPair.factors[first * size + p] = p == candidate ? -1 : std::numeric_limits<double>::max();
    order = assigned(ofPair);
    for (int round = 0; round < maxRounds; ++round) {
      const Order next = assigned(withKnown(ofPair, ofGiven, ofTruth, order, known));
      if (next == order) break;
      order = next;
    }
    const double apart = difference(given, truth, order);
    if (apart >= smallest) continue;
    smallest = apart;
    best = order;
    if (apart < enough / 4) break;
  }
  if (best.empty()) return std::nullopt;
  return best;
}

}  // namespace hemitex::reference
