#include "reference/matrix_smoothing.h"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace hemitex::reference {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

FormFactorMatrix smoothed(const FormFactorMatrix& matrix, std::span<const double> area) {
  const auto size = static_cast<Eigen::Index>(matrix.size);
  assert(area.size() == matrix.size && matrix.factors.size() == matrix.size * matrix.size);
  const Eigen::Map<const Eigen::VectorXd> areas(area.data(), size);
  const Eigen::MatrixXd exchanged =
      areas.asDiagonal() * Eigen::Map<const RowMajor>(matrix.factors.data(), size, size).cwiseMax(0.0);
  const Eigen::MatrixXd mean = (exchanged + exchanged.transpose()) / 2;

  const Eigen::VectorXd sums = mean.rowwise().sum(), missing = exchanged.rowwise().sum() - sums;
  Eigen::MatrixXd equations = mean;
  equations.diagonal() += sums;
  const Eigen::VectorXd x = equations.completeOrthogonalDecomposition().solve(missing);

  FormFactorMatrix result{matrix.size, std::vector<double>(matrix.factors.size())};
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      result.factors[static_cast<std::size_t>(i * size + j)] = mean(i, j) * (1 + x[i] + x[j]) / areas[i];
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
