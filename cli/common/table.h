/// Tables that are written as CSV (see csv_table.h), as a list of JSON objects or, for people, as Markdown.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "radiosity/base/csv_table.h"

namespace hemitex::cli {

using radiosity::Cell, radiosity::Table, radiosity::writeCsv;

/// The table of a list of JSON objects; a single object is one row. Columns are the keys of all objects in the order of
/// first appearance. An inner key has the column `outer inner`. The cell of a list is the number of its entries.
Table tableOf(const nlohmann::ordered_json& records);

/// Writes a title and the table of the objects (tableOf); nothing if there are none. Doubles have three significant
/// digits, and at least all digits before the point.
void writeMarkdown(std::ostream& stream, const std::string& title, const nlohmann::ordered_json& records);
/// JSON holds doubles as CSV does.
nlohmann::ordered_json toJson(const Table& table);

}  // namespace hemitex::cli
