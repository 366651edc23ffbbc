/// A row of form factors, as methods measure it, matrices hold it and files store it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace hemitex::reference {

/// What leaves the receivers of a row; nothing if the method does not look at blockers.
struct OutsideShares {
  std::optional<double> surroundings = {};  ///< share that meets nothing
  std::optional<double> backs = {};         ///< share that meets backs of faces
};

/// The shares of the light of a source that reach n receivers. Those that are not seen have no entry. If the method
/// looks at blockers, columns n and n + 1, surroundings and backs, have entries, and all values sum to 1.
struct SparseRow {
  std::vector<std::uint32_t> column = {};  ///< ascending
  std::vector<double> value = {};          ///< one per column
  std::vector<double> error = {};          ///< one per column: the estimated absolute error; empty if it is not known
  std::optional<double> rowError = {};  ///< estimate of the sum of the absolute errors over receivers, if it is known

  /// The place of a column among the entries; nothing if it has none.
  std::optional<std::size_t> placeOf(std::size_t wanted) const {
    const auto place = std::lower_bound(column.begin(), column.end(), wanted);
    if (place == column.end() || *place != wanted) return std::nullopt;
    return static_cast<std::size_t>(place - column.begin());
  }
  /// Takes the entries of surroundings and backs out of a row.
  OutsideShares takeOutside(std::size_t receivers) {
    if (!placeOf(receivers)) return {};
    const std::size_t left = column.size() - 2;
    const OutsideShares shares{value[left], value[left + 1]};
    column.resize(left);
    value.resize(left);
    error.resize(std::min(left, error.size()));
    return shares;
  }
  /// `value` or `error` as one number for each of the first columns, 0 where there is no entry.
  std::vector<double> spread(const std::vector<double>& entries, std::size_t columns) const {
    std::vector<double> result(columns, 0.0);
    for (std::size_t k = 0; k < entries.size() && column[k] < columns; ++k) result[column[k]] = entries[k];
    return result;
  }
};

}  // namespace hemitex::reference
