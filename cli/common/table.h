/// Tables: what the program prints as CSV (RFC 4180, with a header and plain line ends) or as a list of JSON objects.
/// Rows are made when they are written, so that a million of them take no memory.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace hemitex::cli {

/// Doubles are written as the shortest decimals that read back to the same bits.
using Cell = std::variant<std::string, std::int64_t, double>;

struct Table {
  std::vector<std::string> columns;
  std::size_t size = 0;                               ///< rows
  std::function<std::vector<Cell>(std::size_t)> row;  ///< the cells of a row, one a column
};

void writeCsv(std::ostream& stream, const Table& table);
nlohmann::ordered_json toJson(const Table& table);

}  // namespace hemitex::cli
