#include "reference/truth/solution/row_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "reference/truth/solution/radiosity_error.h"

namespace hemitex::reference {

DenseRows denseRows(const FormFactorMatrix& matrix, const radiosity::Discretization& fine,
                    const radiosity::Discretization& coarse) {
  assert(matrix.size == fine.elements.size());
  const std::vector<std::uint32_t> under = elementsUnder(coarse, fine);
  DenseRows rows{coarse.elements.size(), std::vector<double>(coarse.patches.list.size() * coarse.elements.size())};
  std::vector<double> area(coarse.patches.list.size());
  for (std::size_t from = 0; from < matrix.size; ++from) {
    const std::uint32_t patch = coarse.patches.ofElement[under[from]];
    area[patch] += fine.elements[from].area;
    double* row = rows.factors.data() + patch * rows.elements;
    for (std::size_t to = 0; to < matrix.size; ++to)
      row[under[to]] += fine.elements[from].area * matrix.factors[from * matrix.size + to];
  }
  for (std::size_t i = 0; i < rows.factors.size(); ++i) {
    const double whole = area[i / rows.elements];
    if (whole > 0) rows.factors[i] /= whole;
  }
  return rows;
}

DenseRows denseRows(std::span<const std::optional<radiosity::FormFactorRow>> rows,
                    const radiosity::Discretization& discretization) {
  const std::size_t elements = discretization.elements.size();
  DenseRows result{elements, std::vector<double>(rows.size() * elements)};
  for (std::size_t patch = 0; patch < rows.size(); ++patch) {
    if (!rows[patch]) continue;
    for (std::size_t i = 0; i < rows[patch]->elements.size(); ++i)
      result.factors[patch * elements + rows[patch]->elements[i]] = radiosity::formFactor(rows[patch]->shares[i]);
  }
  return result;
}

RowError rowError(const DenseRows& found, const DenseRows& truth, std::span<const double> flux) {
  assert(found.factors.size() == truth.factors.size() && truth.factors.size() == flux.size() * truth.elements);
  double shot = 0, arrived = 0, missed = 0, squares = 0, largest = 0;
  for (std::size_t patch = 0; patch < flux.size(); ++patch) {
    if (flux[patch] == 0) continue;
    double rowArrived = 0, rowMissed = 0, rowSquares = 0;
    for (std::size_t i = patch * truth.elements; i < (patch + 1) * truth.elements; ++i) {
      const double error = std::abs(found.factors[i] - truth.factors[i]);
      rowArrived += truth.factors[i];
      rowMissed += error;
      rowSquares += error * error;
      largest = std::max(largest, error);
    }
    shot += flux[patch];
    arrived += flux[patch] * rowArrived;
    missed += flux[patch] * rowMissed;
    squares += flux[patch] * rowSquares / static_cast<double>(truth.elements);
  }
  if (missed == 0) return {};
  return {missed / arrived, std::sqrt(squares / shot), largest};
}

}  // namespace hemitex::reference
