#include "cli/common/table.h"

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cassert>
#include <cmath>

#include "raster/base/short_number.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

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
