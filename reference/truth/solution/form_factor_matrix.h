/// Small form-factor matrices, and tests of the properties that all of them have.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hemitex::reference {

/// A square form-factor matrix, row-major: factors[i * size + j] from element i to element j.
struct FormFactorMatrix {
  std::size_t size = 0;
  std::vector<double> factors;

  double at(std::size_t i, std::size_t j) const { return factors[i * size + j]; }
};

struct MatrixChecks {
  double smallestRowSum = 0, largestRowSum = 0;  ///< 1 where a surface sees only fronts, never more
  /// The largest |A_i F_ij - A_j F_ji| / min(A_i, A_j): the difference of the flux in both directions, relative to the
  /// maximum exchange of the smaller one. 0 if reciprocity holds.
  double reciprocity = 0;
  std::size_t from = 0, to = 0;  ///< the pair with that value
};

/// Checks a matrix of at least one row, with the area of each surface or element.
MatrixChecks checkMatrix(const FormFactorMatrix& matrix, std::span<const double> area);

}  // namespace hemitex::reference
