#include "reference/truth/solution/form_factor_matrix.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace hemitex::reference {
MatrixChecks checkMatrix(const FormFactorMatrix& matrix, std::span<const double> area) {
  const std::size_t size = matrix.size;
  assert(size > 0 && area.size() == size && matrix.factors.size() == size * size);
  MatrixChecks checks{.smallestRowSum = std::numeric_limits<double>::infinity()};
  const auto flux = [&](std::size_t i, std::size_t j) { return area[i] * matrix.at(i, j); };
  for (std::size_t i = 0; i < size; ++i) {
    const std::span<const double> row(matrix.factors.data() + i * size, size);
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    checks.smallestRowSum = std::min(checks.smallestRowSum, sum);
    checks.largestRowSum = std::max(checks.largestRowSum, sum);
    for (std::size_t j = 0; j < i; ++j) {
      const double oneWay = std::abs(flux(i, j) - flux(j, i)) / std::min(area[i], area[j]);
      if (oneWay <= checks.reciprocity) continue;
      checks.reciprocity = oneWay;
      checks.from = i;
      checks.to = j;
    }
  }
  return checks;
}

}  // namespace hemitex::reference
