/// What writers of matrices are told and are, and what readers return.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

/// What a file says about a matrix of form factors beside its entries. It has one row per facet, and one column per
/// facet, for `surroundings` and for `backs` (see sparse_matrix.h).
struct MatrixHeading {
  std::vector<double> area;             ///< one per facet, in squared units of the scene
  std::vector<std::string> names = {};  ///< one per facet; empty if facets are known by their numbers
  bool hasErrors = false;               ///< whether each row has the errors of its entries (SparseMatrix::error)

  std::size_t facets() const { return area.size(); }
  std::uint64_t columns() const { return std::uint64_t{area.size()} + 2; }
};

/// Writes the rows of a matrix in order.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Writes the next row; its entries are not 0.
  virtual void write(const SparseRow& row) = 0;
  /// Writes what comes behind the last row.
  virtual void finish() = 0;
};

/// What a file of a matrix holds. Matrices of other programs may have no columns `surroundings` and `backs`.
struct MatrixFile {
  SparseMatrix matrix;
  std::vector<double> area = {};  ///< one per facet; empty if the file has none
};

}  // namespace hemitex::reference
