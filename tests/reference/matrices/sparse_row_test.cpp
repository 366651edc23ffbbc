// SparseRow: entries by their columns.
#include "reference/matrices/sparse_row.h"

#include <catch2/catch.hpp>

using namespace hemitex::reference;

TEST_CASE("SparseRow finds entries, and spreads them over columns", "[rows]") {
  const SparseRow row{{0, 2, 5}, {0.5, 0.25, 0.25}, {0.1, 0.2, 0.3}};
  CHECK(row.placeOf(2) == 1);
  CHECK_FALSE(row.placeOf(1));
  CHECK_FALSE(row.placeOf(6));
  CHECK(row.spread(row.value, 4) == std::vector<double>{0.5, 0, 0.25, 0});
  CHECK(row.spread(row.error, 6) == std::vector<double>{0.1, 0, 0.2, 0, 0, 0.3});
  CHECK(row.spread({}, 2) == std::vector<double>{0, 0});
}

TEST_CASE("SparseRow::takeOutside leaves the receivers", "[rows]") {
  SparseRow row{{1, 3, 4}, {0.5, 0.375, 0.125}, {0.1, 0.2, 0.3}};
  const OutsideShares outside = row.takeOutside(3);
  CHECK(outside.surroundings == 0.375);
  CHECK(outside.backs == 0.125);
  CHECK(row.column == std::vector<std::uint32_t>{1});
  CHECK(row.value == std::vector<double>{0.5});
  CHECK(row.error == std::vector<double>{0.1});
  CHECK_FALSE(row.takeOutside(3).backs);  // as rows of methods that ignore blockers
  CHECK(row.value.size() == 1);
}
