/// Rows on their way into a matrix: the errors of entries become those that files hold, and if wanted the matrix is
/// smoothed.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "reference/matrices/smoothing.h"
#include "reference/matrices/sparse_row.h"

namespace hemitex::reference {

/// By so many of its standard errors smoothing may move an entry.
inline constexpr double maxStandardErrors = 4;

/// The sum of the errors of the entries of a row in the first columns, those of the facets.
double errorOfEntries(const SparseRow& row, std::size_t facets);

class MatrixRows {
 public:
  /// Takes a row of the matrix and the estimate of its error, 0 if it has none.
  using Take = std::function<void(const SparseRow& row, double error)>;

  /// One area per facet. `isBounded`: errors are bounds, and not standard errors.
  MatrixRows(std::vector<double> area, bool isSmooth, bool isBounded, Take take);

  /// Adds the next row. Without smoothing it is taken at once.
  void add(SparseRow row);
  /// To be called after the last row. Returns how far form factors moved, if they were smoothed. Then the error of a
  /// row changes in the ratio of those of its entries.
  std::optional<SmoothingMoves> finish();
  /// Whether a row had the estimate of its own error.
  bool hasRowErrors() const { return hasRowErrors_; }

 private:
  struct RowError {
    double row = 0, ofEntries = 0;
  };

  std::size_t facets_;
  std::optional<MatrixSmoother> smoother_;
  Take take_;
  std::vector<RowError> measured_;  ///< of rows that wait for smoothing
  bool hasRowErrors_ = false;
};

}  // namespace hemitex::reference
