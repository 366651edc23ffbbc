#include "cli/common/table.h"

#include <cassert>

#include "cli/common/numbers.h"

namespace hemitex::cli {
namespace {

/// A field of a CSV file, quoted where it has to be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

std::string field(std::int64_t number) { return std::to_string(number); }
std::string field(double number) { return toText(number); }

void writeLine(std::ostream& stream, const std::vector<std::string>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) stream << (i > 0 ? "," : "") << fields[i];
  stream << '\n';
}

}  // namespace

void writeCsv(std::ostream& stream, const Table& table) {
  writeLine(stream, table.columns);
  for (std::size_t i = 0; i < table.size; ++i) {
    std::vector<std::string> fields;
    for (const Cell& cell : table.row(i))
      fields.push_back(std::visit([](const auto& value) { return field(value); }, cell));
    assert(fields.size() == table.columns.size());
    writeLine(stream, fields);
  }
}

nlohmann::ordered_json toJson(const Table& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < table.size; ++i) {
    const std::vector<Cell> cells = table.row(i);
    assert(cells.size() == table.columns.size());
    nlohmann::ordered_json row;
    for (std::size_t c = 0; c < cells.size(); ++c)
      std::visit([&](const auto& value) { row[table.columns[c]] = value; }, cells[c]);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace hemitex::cli
