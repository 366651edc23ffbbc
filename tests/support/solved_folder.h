/// The files of a solved folder: solution.json, and elements.csv by columns.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/shell.h"

namespace hemitex::tests {

inline nlohmann::json solutionOf(const Shell& shell, const std::string& folder) {
  return nlohmann::json::parse(readAll(shell.file(folder + "/solution.json")));
}

inline std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

/// The fields of a column of a solved folder's elements.csv, in its order.
inline std::vector<std::string> columnOf(const Shell& shell, const std::string& folder, const std::string& name) {
  const std::vector<std::string> lines = linesOf(readAll(shell.file(folder + "/elements.csv")));
  const std::vector<std::string> names = fieldsOf(lines.front());
  const auto at = std::find(names.begin(), names.end(), name);
  REQUIRE(at != names.end());
  std::vector<std::string> fields;
  for (std::size_t i = 1; i < lines.size(); ++i)
    fields.push_back(fieldsOf(lines[i])[static_cast<std::size_t>(at - names.begin())]);
  return fields;
}

}  // namespace hemitex::tests
