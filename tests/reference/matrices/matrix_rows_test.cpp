/// MatrixRows: rows with the errors that files hold, smoothed if wanted.
#include "reference/matrices/matrix_rows.h"

#include <catch2/catch.hpp>

#include "reference/matrices/sparse_matrix.h"

using namespace hemitex::reference;

namespace {

struct Taken {
  std::vector<SparseRow> rows;
  std::vector<double> errors;
};

/// The rows of two facets of areas 1 and 2 that see each other and the surroundings.
Taken taken(bool isSmooth, bool isBounded) {
  Taken result;
  MatrixRows rows({1, 2}, isSmooth, isBounded, [&](const SparseRow& row, double error) {
    result.rows.push_back(row);
    result.errors.push_back(error);
  });
  rows.add({{1, 2, 3}, {0.5, 0.5, 0}, {0.1, 0.1, 0}, 0.2});
  rows.add({{0, 2, 3}, {0.25, 0.75, 0}, {0.0625, 0.0625, 0}, 0.125});
  CHECK(rows.hasRowErrors());
  CHECK(rows.finish().has_value() == isSmooth);
  return result;
}

}  // namespace

TEST_CASE("MatrixRows rounds the errors of entries as files hold them", "[matrix_rows]") {
  const Taken result = taken(false, true);
  REQUIRE(result.rows.size() == 2);
  CHECK(result.rows[0].error == std::vector<double>{asStored(0.1), asStored(0.1), 0});
  CHECK(result.errors == std::vector<double>{0.2, 0.125});
  CHECK(errorOfEntries(result.rows[1], 2) == 0.0625);
}

TEST_CASE("MatrixRows smooths rows, and their errors change in the ratio of those of their entries", "[matrix_rows]") {
  const Taken result = taken(true, true);
  REQUIRE(result.rows.size() == 2);
  CHECK(result.rows[0].value == std::vector<double>{0.5, 0.5});  // reciprocal already
  // Both measurements of the exchange have errors of about .1 and .125: their harmonic mean is 1/9.
  CHECK(result.rows[0].error[0] == Approx(1 / 9.0).epsilon(1e-6));
  CHECK(result.errors[0] == Approx(0.2 / 0.9).epsilon(1e-6));
  CHECK(result.errors[1] == Approx(0.125 / 1.125).epsilon(1e-6));
}
