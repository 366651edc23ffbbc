// checkMatrix finds errors added to a valid matrix.
#include "reference/truth/solution/form_factor_matrix.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace hemitex::reference;

TEST_CASE("checkMatrix accepts a reciprocal, closed matrix, and measures each error", "[matrix checks]") {
  // Areas 1, 2, 4 and A_i F_ij = A_j F_ji = 0.25, 0.5, 0.75; the diagonal closes the rows.
  const std::vector<double> area{1, 2, 4};
  const FormFactorMatrix matrix{3, {0.25, 0.25, 0.5, 0.125, 0.5, 0.375, 0.125, 0.1875, 0.6875}};
  const MatrixChecks right = checkMatrix(matrix, area);
  CHECK(right.smallestRowSum == 1);
  CHECK(right.largestRowSum == 1);
  CHECK(right.reciprocity == 0);

  FormFactorMatrix wrong = matrix;
  wrong.factors[2 * 3 + 1] += 0.125;  // from 2 to 1: 4 * 0.125 of flux without a counterpart, over the area 2
  const MatrixChecks found = checkMatrix(wrong, area);
  CHECK(found.reciprocity == 0.25);
  CHECK(found.from == 2);
  CHECK(found.to == 1);
  CHECK(found.largestRowSum == 1.125);
  wrong.factors[0] -= 0.125;
  CHECK(checkMatrix(wrong, area).smallestRowSum == 0.875);
}
