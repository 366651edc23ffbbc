#include "reference/truth/solution/reciprocity_smoothing.h"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "reference/truth/solution/form_factor_matrix.h"

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
