/// Sparse matrices in compressed rows, as SciPy's `csr_array` keeps them, and what their files say beside.
///
/// A matrix of form factors has one row per facet, in the order of the file. It has one column per facet, and two more:
/// the share that meets nothing (`surroundings`) and the share that meets backs of faces (`backs`). Each row with both
/// sums to 1. Matrices of other programs are often square.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/matrices/sparse_row.h"

namespace hemitex::reference {

/// Row r has the entries [rowStart[r], rowStart[r + 1]) of `column` and `value`. Columns of a row ascend.
struct SparseMatrix {
  std::uint64_t columns = 0;
  std::vector<std::uint64_t> rowStart{0};  ///< one more than there are rows
  std::vector<std::uint32_t> column = {};
  std::vector<double> value = {};
  std::vector<double> error = {};  ///< estimated absolute error of each entry; empty if errors are not known

  std::size_t rows() const { return rowStart.size() - 1; }
  SparseRow row(std::size_t r) const;
  /// The place of an entry in `column`; nothing if there is none.
  std::optional<std::size_t> placeOf(std::size_t r, std::uint32_t c) const;
  /// Appends a row. Entries of value 0 are left out. All rows have errors, or none has.
  void append(const SparseRow& row);
  bool operator==(const SparseMatrix&) const = default;
};

/// An error of an entry as files hold it, rounded to binary32.
inline double asStored(double error) { return static_cast<double>(static_cast<float>(error)); }

/// The matrix has fewer columns than this.
inline constexpr std::uint64_t maxColumns = std::uint64_t{1} << 31;

/// One entry of a matrix whose entries come in any order.
struct MatrixEntry {
  std::uint32_t row = 0, column = 0;
  double value = 0;
};

/// The matrix of entries, which it sorts. Entries must lie inside. Throws InputError that names `file` where two
/// entries have one place.
SparseMatrix matrixOf(std::vector<MatrixEntry> entries, std::size_t rows, std::uint64_t columns,
                      const std::string& file);

/// Sorts the columns of each row. Throws InputError that names `file` unless rowStart ascends from 0 to the number of
/// entries, columns are in range and once in a row, and values are finite.
void checkAndSort(SparseMatrix& matrix, const std::string& file);

/// What a file says about a matrix of form factors beside its entries. It has one row per facet, and one column per
/// facet, for `surroundings` and for `backs`.
struct MatrixHeading {
  std::vector<double> area;             ///< one per facet, in squared units of the scene
  std::vector<std::string> names = {};  ///< one per facet; empty if facets are known by their numbers
  bool hasErrors = false;               ///< whether each row has the errors of its entries (SparseMatrix::error)

  std::size_t facets() const { return area.size(); }
  std::uint64_t columns() const { return std::uint64_t{area.size()} + 2; }
};

/// The heading of facets with these names, which are left out if they are the numbers of the facets.
MatrixHeading headingOf(std::vector<double> area, const std::vector<std::string>& names);

/// Writes a matrix row by row, and keeps no entries in memory. What it writes is complete after `finish` alone, so the
/// file should have a temporary name until then. Both functions throw InputError if the file cannot be written.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Writes the next row, without entries that are 0.
  void write(const SparseRow& row) {
    SparseMatrix kept;
    kept.append(row);
    append(kept.row(0));
  }
  /// Writes what comes behind the last row. To be called after as many rows as there are facets.
  virtual void finish() = 0;

 private:
  virtual void append(const SparseRow& row) = 0;
};

/// What a file of a matrix holds. Matrices of other programs may have no columns `surroundings` and `backs`.
struct MatrixFile {
  SparseMatrix matrix;
  std::vector<double> area = {};  ///< one per facet; empty if the file has none
};

}  // namespace hemitex::reference
