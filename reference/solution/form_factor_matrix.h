/// Matrices of form factors: what holds for each of them, and by how much one misses it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hemitex::reference {

/// A square matrix of form factors, row-major: factors[i * size + j] from element i to element j.
struct FormFactorMatrix {
  std::size_t size = 0;
  std::vector<double> factors;
};

struct MatrixChecks {
  double smallestRowSum = 0, largestRowSum = 0;  ///< 1 where a surface sees nothing but fronts, never more
  /// The largest |A_i F_ij - A_j F_ji| / min(A_i, A_j): flux that goes one way only, in parts of what the smaller of
  /// the two exchanges at most. 0 where light may be followed either way.
  double reciprocity = 0;
  std::size_t from = 0, to = 0;  ///< where that is
};

/// Of a matrix of at least one row, with the area of each surface or element.
MatrixChecks checkMatrix(const FormFactorMatrix& matrix, std::span<const double> area);

}  // namespace hemitex::reference
