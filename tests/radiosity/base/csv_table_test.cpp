#include "radiosity/base/csv_table.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace hemitex::radiosity;

TEST_CASE("writeCsv quotes separators, and writes doubles with all their digits", "[table]") {
  const std::vector<std::vector<Cell>> rows{{"a,b", std::int64_t{-7}, 0.1}, {"\"c\"\n\x1B[", std::int64_t{8}, 1e-300}};
  std::ostringstream csv;
  writeCsv(csv, {{"name", "count", "value"}, rows.size(), [&rows](std::size_t row) { return rows[row]; }});
  CHECK(csv.str() == "name,count,value\n\"a,b\",-7,0.1\n\"\"\"c\"\"??[\",8,1e-300\n");
}

TEST_CASE("writeCsv writes the rows of a long table in order", "[table]") {
  // More rows than are made at once: 64 blocks of 1024, and a rest.
  const Table table{{"row"}, 150000, [](std::size_t row) { return std::vector<Cell>{std::int64_t(row)}; }};
  std::ostringstream csv;
  writeCsv(csv, table);
  std::string expected = "row\n";
  for (int row = 0; row < 150000; ++row) expected += std::to_string(row) + "\n";
  CHECK(csv.str() == expected);
}
