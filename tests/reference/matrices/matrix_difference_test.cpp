/// matrixDifference: what two matrices of one mesh exchange differently.
#include "reference/matrices/matrix_difference.h"

#include <catch2/catch.hpp>

using namespace hemitex::reference;

TEST_CASE("matrixDifference is 0 for equal matrices, with columns behind the facets or without",
          "[matrix_difference]") {
  SparseMatrix square{.columns = 2}, whole{.columns = 4};
  square.append({{1}, {0.5}});
  square.append({{0}, {0.25}});
  whole.append({{1, 2}, {0.5, 0.5}});
  whole.append({{0, 3}, {0.25, 0.75}});
  const MatrixDifference found = matrixDifference(square, whole, {1, 2});
  CHECK(found.share == 0);
  CHECK(found.sum == std::vector<double>{0.5, 0.25});
  CHECK(found.difference == std::vector<double>{0, 0});
}

TEST_CASE("matrixDifference weights rows by areas, and counts entries of either matrix", "[matrix_difference]") {
  SparseMatrix a{.columns = 2}, b{.columns = 2};
  a.append({{1}, {0.5}});
  a.append({{0}, {0.25}});
  b.append({{0, 1}, {0.125, 0.375}});
  b.append({});
  const MatrixDifference found = matrixDifference(a, b, {1, 2});
  CHECK(found.difference == std::vector<double>{0.25, 0.25});
  CHECK(found.received == std::vector<double>{0.125 + 0.5, 0.0625});
  CHECK(found.share == 0.75);
}
