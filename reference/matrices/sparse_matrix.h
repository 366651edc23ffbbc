/// Sparse matrices in compressed rows, as SciPy's `csr_array` keeps them.
///
/// A matrix of form factors has one row per facet, in the order of the file. It has one column per facet, and two more:
/// the share that meets nothing (`surroundings`) and the share that meets backs of faces (`backs`). Each row with both
/// sums to 1. Matrices of other programs are often square.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hemitex::reference {

/// The entries of a row. Columns ascend.
struct SparseRow {
  std::span<const std::uint32_t> column = {};
  std::span<const double> value = {};
  std::span<const float> error = {};  ///< as SparseMatrix::error
};

/// Row r has the entries [rowStart[r], rowStart[r + 1]) of `column` and `value`. Columns of a row ascend.
struct SparseMatrix {
  std::uint64_t columns = 0;
  std::vector<std::uint64_t> rowStart{0};  ///< one more than there are rows
  std::vector<std::uint32_t> column = {};
  std::vector<double> value = {};
  std::vector<float> error = {};  ///< estimated absolute error of each entry; empty if errors are not known

  std::size_t rows() const { return rowStart.size() - 1; }
  SparseRow row(std::size_t r) const;
  /// Appends a row. Entries of value 0 are left out. All rows have errors, or none has.
  void append(const SparseRow& row);
  bool operator==(const SparseMatrix&) const = default;
};

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

}  // namespace hemitex::reference
