#include "raster/base/name_suggestions.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

constexpr std::size_t maxSuggestions = 3;

/// The number of letters to insert, delete or change (Levenshtein 1966), row by row of the table of all pairs of
/// prefixes.
std::size_t editDistance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearestNames(const std::set<std::string>& names, const std::string& wrong) {
  std::set<std::pair<std::size_t, std::string>> nearest;
  for (const std::string& name : names) {
    nearest.emplace(editDistance(wrong, name), name);
    if (nearest.size() > maxSuggestions) nearest.erase(std::prev(nearest.end()));
  }
  std::string text;
  for (const auto& [distance, name] : nearest) text += (text.empty() ? "`" : ", `") + excerpt(name) + "`";
  return text;
}

}  // namespace hemitex::raster
