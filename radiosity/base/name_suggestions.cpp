#include "radiosity/base/name_suggestions.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

constexpr std::size_t maxSuggestions = 3;
constexpr std::size_t maxCompared = 64;  ///< bytes of the parts of two names that differ

/// Removes the beginning and the end that two names share, which do not change their edit distance.
void removeShared(std::string_view& a, std::string_view& b) {
  const auto begin = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto shared = static_cast<std::size_t>(begin.first - a.begin());
  a.remove_prefix(shared);
  b.remove_prefix(shared);
  const auto end = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  const auto sharedEnd = static_cast<std::size_t>(end.first - a.rbegin());
  a.remove_suffix(sharedEnd);
  b.remove_suffix(sharedEnd);
}

/// The number of letters to insert, delete or change (Levenshtein 1966), row by row of the table of all pairs of
/// prefixes. Of parts that differ and are long, only the beginnings are compared, and the rest counts as changed, so
/// that the time is linear in the lengths of names. At least `limit` where the distance is.
std::size_t editDistance(std::string_view from, std::string_view to, std::size_t limit) {
  removeShared(from, to);
  const std::size_t longer = std::max(from.size(), to.size());
  const std::size_t rest = longer - std::min(longer, maxCompared);
  from = from.substr(0, maxCompared);
  to = to.substr(0, maxCompared);
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
    if (*std::min_element(row.begin(), row.end()) + rest > limit) return limit + 1;
  }
  return row.back() + rest;
}

}  // namespace

std::string nearestNames(const std::set<std::string>& names, const std::string& wrong) {
  std::set<std::pair<std::size_t, std::string_view>> nearest;
  for (const std::string& name : names) {
    const std::size_t limit = nearest.size() < maxSuggestions ? wrong.size() + name.size() : nearest.rbegin()->first;
    nearest.emplace(editDistance(wrong, name, limit), name);
    if (nearest.size() > maxSuggestions) nearest.erase(std::prev(nearest.end()));
  }
  std::string text;
  for (const auto& [distance, name] : nearest) text += (text.empty() ? "`" : ", `") + raster::excerpt(name) + "`";
  return text;
}

}  // namespace hemitex::radiosity
