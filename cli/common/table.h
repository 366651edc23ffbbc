/// Tables that are written as CSV, as a list of JSON objects or, for people, as Markdown. CSV follows RFC 4180, with a
/// header and LF line ends. Rows are made when they are written, so that a million rows take no memory.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace hemitex::cli {

/// CSV and JSON hold doubles as the shortest decimals that read back to the same bits.
using Cell = std::variant<std::string, std::int64_t, double>;

struct Table {
  std::vector<std::string> columns;
  std::size_t size = 0;  ///< number of rows
  /// The cells of a row, one per column. Several threads may call it at the same time.
  std::function<std::vector<Cell>(std::size_t)> row;
};

/// The table of a list of JSON objects; a single object is one row. Columns are the keys of all objects in the order of
/// first appearance. An inner key has the column `outer inner`. The cell of a list is the number of its entries.
Table tableOf(const nlohmann::ordered_json& records);

void writeCsv(std::ostream& stream, const Table& table);
/// Writes a title and the table of the objects (tableOf); nothing if there are none. Doubles have three significant
/// digits, and at least all digits before the point.
void writeMarkdown(std::ostream& stream, const std::string& title, const nlohmann::ordered_json& records);
nlohmann::ordered_json toJson(const Table& table);

}  // namespace hemitex::cli
