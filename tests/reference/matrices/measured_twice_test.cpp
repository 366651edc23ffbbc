/// MeasuredTwice: what both measurements of an exchange say of their errors.
#include "reference/matrices/measured_twice.h"

#include <catch2/catch.hpp>

using namespace hemitex::reference;

TEST_CASE("MeasuredTwice keeps the errors of rows that agree", "[measured_twice]") {
  MeasuredTwice measured({1, 2});
  const SparseRow first{{1, 2}, {0.5, 0.5}, {0.03125, 0.03125}, 0.0625},
      second{{0, 2}, {0.28125, 0.71875}, {0.03125, 0.03125}, 0.0625};
  measured.add(first);
  measured.add(second);
  for (const auto& [number, row] : {std::pair(0U, first), {1U, second}}) {
    SparseRow widened = row;
    measured.widen(number, widened);
    CHECK(widened.error == row.error);
    CHECK(widened.rowError == row.rowError);
  }
}

TEST_CASE("MeasuredTwice gives both entries that contradict each other their difference as error", "[measured_twice]") {
  MeasuredTwice measured({1, 2, 1});
  SparseRow first{{1, 2, 3}, {0.5, 0.25, 0.25}, {0.0625, 0.0625, 0.0625}, 0.125},
      second{{0, 3}, {0.125, 0.875}, {0.0625, 0.0625}, 0.125}, third{{3}, {1}, {0.0625}, 0.0625};
  for (const SparseRow* row : {&first, &second, &third}) measured.add(*row);
  measured.widen(0, first);
  measured.widen(1, second);
  measured.widen(2, third);
  // From 0 to 1 it is .5 or 2 x .125; from 0 to 2 .25 or nothing.
  CHECK(first.error == std::vector<double>{0.25, 0.25, 0.0625});
  CHECK(*first.rowError == 0.125 + 2 * (0.25 - 0.0625));
  CHECK(second.error == std::vector<double>{0.125, 0.0625});
  CHECK(*second.rowError == 0.125 + (0.125 - 0.0625));
  CHECK(third.error == std::vector<double>{0.0625});
  CHECK(*third.rowError == 0.0625 + 0.25);
}
