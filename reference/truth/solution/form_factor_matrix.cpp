#include "reference/truth/solution/form_factor_matrix.h"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace hemitex::reference {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The Lagrange multipliers for a symmetric exchange whose row sums have the errors `missing`.
Eigen::VectorXd multipliers(const Eigen::MatrixXd& exchange, const Eigen::VectorXd& missing) {
  const Eigen::VectorXd sums = exchange.rowwise().sum();
  // In units of each surface's own exchange, so that small values are not lost in the rounding error of large ones.
  const Eigen::VectorXd unit = sums.unaryExpr([](double sum) { return sum > 0 ? 1 / std::sqrt(sum) : 0; });
  Eigen::MatrixXd equations = exchange;
  equations.diagonal() += sums;
  equations = unit.asDiagonal() * equations * unit.asDiagonal();
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(equations);
  const Eigen::VectorXd right = unit.cwiseProduct(missing), first = solver.solve(right);
  return unit.cwiseProduct(first + solver.solve(right - equations * first));
}

}  // namespace

MatrixChecks checkMatrix(const FormFactorMatrix& matrix, std::span<const double> area) {
  const std::size_t size = matrix.size;
  assert(size > 0 && area.size() == size && matrix.factors.size() == size * size);
  MatrixChecks checks{.smallestRowSum = std::numeric_limits<double>::infinity()};
  const auto flux = [&](std::size_t i, std::size_t j) { return area[i] * matrix.factors[i * size + j]; };
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

FormFactorMatrix smoothed(const FormFactorMatrix& matrix, std::span<const double> area) {
  const auto size = static_cast<Eigen::Index>(matrix.size);
  assert(area.size() == matrix.size && matrix.factors.size() == matrix.size * matrix.size);
  const Eigen::Map<const Eigen::VectorXd> areas(area.data(), size);
  const Eigen::MatrixXd exchanged =
      areas.asDiagonal() * Eigen::Map<const RowMajor>(matrix.factors.data(), size, size).cwiseMax(0.0);
  Eigen::MatrixXd mean = (exchanged + exchanged.transpose()) / 2, moved;
  for (bool isBelow = true; isBelow;) {
    const Eigen::VectorXd missing = exchanged.rowwise().sum() - mean.rowwise().sum();
    const Eigen::VectorXd x = multipliers(mean, missing);
    moved = mean.array() * (1 + (x.rowwise().replicate(size) + x.transpose().colwise().replicate(size)).array());
    isBelow = (moved.array() < 0).any();
    mean = (moved.array() < 0).select(0, mean);
  }
  FormFactorMatrix result{matrix.size, std::vector<double>(matrix.factors.size())};
  Eigen::Map<RowMajor>(result.factors.data(), size, size) = areas.cwiseInverse().asDiagonal() * moved;
  return result;
}

MatrixDifference difference(const FormFactorMatrix& a, const FormFactorMatrix& b) {
  assert(a.size == b.size && a.size > 0);
  MatrixDifference result;
  double squares = 0;
  for (std::size_t i = 0; i < a.factors.size(); ++i) {
    const double moved = std::abs(a.factors[i] - b.factors[i]);
    result.largest = std::max(result.largest, moved);
    squares += moved * moved;
  }
  result.rootMeanSquare = std::sqrt(squares / static_cast<double>(a.factors.size()));
  return result;
}

}  // namespace hemitex::reference
