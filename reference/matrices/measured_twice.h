/// Both measurements of an exchange, A_i F_ij and A_j F_ji, as part of the estimated error of both. Each estimate comes
/// from its own row. If the two measurements differ by more than the sum of their errors, one of the estimates is too
/// small. Either may be, so that both are raised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/matrices/sparse_row.h"

namespace hemitex::reference {

/// Keeps 16 bytes per entry.
class MeasuredTwice {
 public:
  /// One area per facet, above 0 for facets with entries.
  explicit MeasuredTwice(std::vector<double> area);

  /// Adds the next row. Rows without errors are not changed later.
  void add(const SparseRow& row);
  /// To be called after all rows, with a row as it was added. The error of an entry that contradicts the other
  /// measurement becomes their difference. The error of the row grows by as much, and by what others alone see.
  void widen(std::uint32_t number, SparseRow& row) const;

 private:
  struct Measurement {
    std::uint32_t column;
    float error;
    double flux;
  };

  const Measurement* find(std::uint32_t row, std::uint32_t column) const;

  std::vector<double> area_;
  std::vector<Measurement> measurements_;  ///< row by row
  std::vector<std::size_t> firstOf_{0};    ///< of each row, and one more
  std::vector<double> missed_;             ///< of each row: flux that only others measured
};

}  // namespace hemitex::reference
