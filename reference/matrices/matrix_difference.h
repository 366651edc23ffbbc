/// How far two matrices of one mesh are apart.
#pragma once

#include <vector>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

/// One number per facet each, and one for all.
struct MatrixDifference {
  std::vector<double> sum;         ///< of the row of the first matrix, over facets
  std::vector<double> difference;  ///< sum of the absolute differences of the row
  std::vector<double> received;    ///< by how much the light differs that each facet receives from radiosity 1
  double share = 0;                ///< of the exchange between facets: sum of A_i |F_ij - G_ij| over that of A_i F_ij
};

/// Both matrices have a row and a column for each of the areas. Columns behind those do not count.
MatrixDifference matrixDifference(const SparseMatrix& a, const SparseMatrix& b, const std::vector<double>& area);

}  // namespace hemitex::reference
