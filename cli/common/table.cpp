#include "cli/common/table.h"

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <cassert>
#include <cmath>

#include "cli/common/numbers.h"
#include "raster/base/parallel.h"
#include "raster/base/short_number.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

/// A field of a CSV file, quoted if it contains a separator.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  return '"' + boost::replace_all_copy(text, "\"", "\"\"") + '"';
}

std::string field(std::int64_t number) { return std::to_string(number); }
std::string field(double number) { return toText(number); }

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

std::string rounded(const std::string& text) { return text; }
std::string rounded(std::int64_t number) { return std::to_string(number); }
std::string rounded(double number) {
  return std::abs(number) >= 1000 ? std::to_string(std::llround(number)) : raster::shortNumber(number);
}

Cell cellOf(const ordered_json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return value.get<double>();
  if (value.is_array()) return static_cast<std::int64_t>(value.size());
  return value.is_boolean() ? std::int64_t{value.get<bool>()} : value.get<std::int64_t>();
}

/// Appends the cells of an object.
void addCells(const ordered_json& object, const std::string& outer, std::vector<std::pair<std::string, Cell>>& cells) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object())
      addCells(value, outer + key + ' ', cells);
    else
      cells.emplace_back(outer + key, cellOf(value));
  }
}

}  // namespace

Table tableOf(const ordered_json& records) {
  std::vector<std::vector<std::pair<std::string, Cell>>> objects;
  Table table;
  for (const ordered_json& record : records.is_array() ? records : ordered_json::array({records})) {
    addCells(record, "", objects.emplace_back());
    for (const auto& [key, cell] : objects.back())
      if (std::count(table.columns.begin(), table.columns.end(), key) == 0) table.columns.push_back(key);
  }
  table.size = objects.size();
  table.row = [objects, columns = table.columns](std::size_t i) {
    std::vector<Cell> cells(columns.size());
    for (const auto& [key, cell] : objects[i])
      cells[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), key) - columns.begin())] = cell;
    return cells;
  };
  return table;
}

void writeMarkdown(std::ostream& stream, const std::string& title, const ordered_json& records) {
  if (records.empty()) return;
  const Table table = tableOf(records);
  const auto writeRow = [&stream](const std::vector<std::string>& cells) {
    stream << "| " << boost::join(cells, " | ") << " |\n";
  };
  stream << title << "\n\n";
  writeRow(table.columns);
  writeRow(std::vector<std::string>(table.columns.size(), "---"));
  for (std::size_t i = 0; i < table.size; ++i) {
    std::vector<std::string> cells;
    for (const Cell& cell : table.row(i))
      cells.push_back(std::visit([](const auto& value) { return rounded(value); }, cell));
    writeRow(cells);
  }
  stream << '\n';
}

void writeCsv(std::ostream& stream, const Table& table) {
  constexpr std::size_t rowsOfBlock = 1024, blocksAtOnce = 64;
  stream << boost::join(table.columns, ",") << '\n';
  std::vector<std::string> blocks(blocksAtOnce);
  for (std::size_t first = 0; first < table.size; first += rowsOfBlock * blocksAtOnce) {
    raster::parallelFor(blocksAtOnce, [&](std::size_t block) {
      const std::size_t begin = std::min(first + block * rowsOfBlock, table.size);
      blocks[block] = csvLines(table, begin, std::min(begin + rowsOfBlock, table.size));
    });
    for (const std::string& block : blocks) stream << block;
  }
}

ordered_json toJson(const Table& table) {
  ordered_json rows = ordered_json::array();
  for (std::size_t i = 0; i < table.size; ++i) {
    const std::vector<Cell> cells = table.row(i);
    assert(cells.size() == table.columns.size());
    ordered_json row;
    for (std::size_t c = 0; c < cells.size(); ++c)
      std::visit([&](const auto& value) { row[table.columns[c]] = value; }, cells[c]);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace hemitex::cli
