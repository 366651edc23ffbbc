/// Tables that are written as CSV, which follows RFC 4180, with a header and LF line ends. Texts are printable
/// (printable_text.h), so that each row is a line and a terminal may show it. Rows are made when they are
/// written, so that a million rows take no memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace hemitex::radiosity {

/// Doubles are written as the shortest decimals that read back to the same bits.
using Cell = std::variant<std::string, std::int64_t, double>;

struct Table {
  std::vector<std::string> columns;
  std::size_t size = 0;  ///< number of rows
  /// The cells of a row, one per column. Several threads may call it at the same time.
  std::function<std::vector<Cell>(std::size_t)> row;
};

void writeCsv(std::ostream& stream, const Table& table);

}  // namespace hemitex::radiosity
