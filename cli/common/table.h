/// Tables: what the program prints as CSV (RFC 4180, with a header and plain line ends), as a list of JSON objects or,
/// for people, as Markdown. Rows are made when they are written, so that a million of them take no memory.
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

/// The table of a list of JSON objects; a single object is one row. Columns are the keys of all objects, in the order
/// in which they first appear; a key inside a key has the column `outer inner`. A list counts its entries.
Table tableOf(const nlohmann::ordered_json& records);

void writeCsv(std::ostream& stream, const Table& table);
/// A title and the table of these objects (tableOf), or nothing where there are none. Doubles have three significant
/// digits, and all digits before the point.
void writeMarkdown(std::ostream& stream, const std::string& title, const nlohmann::ordered_json& records);
nlohmann::ordered_json toJson(const Table& table);

}  // namespace hemitex::cli
