/// Spelling suggestions: the known names nearest to a wrong one.
#pragma once

#include <set>
#include <string>

namespace hemitex::radiosity {

/// The three names with the smallest edit distance (Levenshtein 1966), quoted, nearest first.
std::string nearestNames(const std::set<std::string>& names, const std::string& wrong);

}  // namespace hemitex::radiosity
