#include "radiosity/base/csv_table.h"

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <cassert>

#include "raster/base/parallel.h"
#include "raster/base/printable_text.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

/// A field of a CSV file, quoted if it contains a separator.
std::string field(const std::string& raw) {
  const std::string text = raster::printable(raw);
  if (text.find_first_of(",\"") == std::string::npos) return text;
  return '"' + boost::replace_all_copy(text, "\"", "\"\"") + '"';
}

std::string field(std::int64_t number) { return std::to_string(number); }
std::string field(double number) { return raster::toText(number); }

/// Lines [first, end) of a CSV file.
std::string csvLines(const Table& table, std::size_t first, std::size_t end) {
  std::string text;
  for (std::size_t i = first; i < end; ++i) {
    std::vector<std::string> fields;
    for (const Cell& cell : table.row(i))
      fields.push_back(std::visit([](const auto& value) { return field(value); }, cell));
    assert(fields.size() == table.columns.size());
    text += boost::join(fields, ",") + '\n';
  }
  return text;
}

}  // namespace

void writeCsv(std::ostream& stream, const Table& table) {
  constexpr std::size_t rowsOfBlock = 1024, blocksAtOnce = 64;
  std::vector<std::string> columns;
  for (const std::string& column : table.columns) columns.push_back(field(column));
  stream << boost::join(columns, ",") << '\n';
  std::vector<std::string> blocks(blocksAtOnce);
  for (std::size_t first = 0; first < table.size; first += rowsOfBlock * blocksAtOnce) {
    raster::parallelFor(blocksAtOnce, [&](std::size_t block) {
      const std::size_t begin = std::min(first + block * rowsOfBlock, table.size);
      blocks[block] = csvLines(table, begin, std::min(begin + rowsOfBlock, table.size));
    });
    for (const std::string& block : blocks) stream << block;
  }
}

}  // namespace hemitex::radiosity
