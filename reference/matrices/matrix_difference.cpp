#include "reference/matrices/matrix_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hemitex::reference {
namespace {

/// Calls take(to, a, b) for each facet that a row has an entry for in a or b.
template <typename Take>
void forEachPair(const SparseRow& a, const SparseRow& b, std::uint32_t facets, const Take& take) {
  std::size_t i = 0, k = 0;
  const auto isLeft = [&](const SparseRow& row, std::size_t at) {
    return at < row.column.size() && row.column[at] < facets;
  };
  while (isLeft(a, i) || isLeft(b, k)) {
    const std::uint32_t column = std::min(isLeft(a, i) ? a.column[i] : facets, isLeft(b, k) ? b.column[k] : facets);
    const double x = isLeft(a, i) && a.column[i] == column ? a.value[i++] : 0,
                 y = isLeft(b, k) && b.column[k] == column ? b.value[k++] : 0;
    take(column, x, y);
  }
}

}  // namespace

MatrixDifference matrixDifference(const SparseMatrix& a, const SparseMatrix& b, const std::vector<double>& area) {
  const std::size_t facets = area.size();
  MatrixDifference result{std::vector<double>(facets), std::vector<double>(facets), std::vector<double>(facets)};
  double all = 0, apart = 0;
  for (std::size_t f = 0; f < facets; ++f) {
    forEachPair(a.row(f), b.row(f), static_cast<std::uint32_t>(facets), [&](std::uint32_t to, double x, double y) {
      result.sum[f] += x;
      result.difference[f] += std::abs(x - y);
      if (area[to] > 0) result.received[to] += area[f] * std::abs(x - y) / area[to];
    });
    all += area[f] * result.sum[f];
    apart += area[f] * result.difference[f];
  }
  if (all > 0) result.share = apart / all;
  return result;
}

}  // namespace hemitex::reference
