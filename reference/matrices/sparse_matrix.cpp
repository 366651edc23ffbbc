#include "reference/matrices/sparse_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::reference {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw raster::InputError(file, 0, what, "write the file again");
}

[[noreturn]] void failTwice(const std::string& file, std::size_t row, std::uint32_t column) {
  fail(file, "row " + std::to_string(row) + " has column " + std::to_string(column) + " twice, counted from 0");
}

void sortRow(SparseMatrix& matrix, std::size_t begin, std::size_t end) {
  std::vector<std::size_t> order(end - begin);
  std::iota(order.begin(), order.end(), begin);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return matrix.column[a] < matrix.column[b]; });
  const auto reorder = [&](auto& values) {
    const std::vector before(values.begin() + static_cast<std::ptrdiff_t>(begin),
                             values.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t i = 0; i < order.size(); ++i) values[begin + i] = before[order[i] - begin];
  };
  reorder(matrix.column);
  reorder(matrix.value);
  if (!matrix.error.empty()) reorder(matrix.error);
}

}  // namespace

SparseRow SparseMatrix::row(std::size_t r) const {
  const auto begin = static_cast<std::ptrdiff_t>(rowStart[r]), end = static_cast<std::ptrdiff_t>(rowStart[r + 1]);
  SparseRow row{{column.begin() + begin, column.begin() + end}, {value.begin() + begin, value.begin() + end}};
  if (!error.empty()) row.error.assign(error.begin() + begin, error.begin() + end);
  return row;
}

std::optional<std::size_t> SparseMatrix::placeOf(std::size_t r, std::uint32_t c) const {
  const auto end = column.begin() + static_cast<std::ptrdiff_t>(rowStart[r + 1]);
  const auto place = std::lower_bound(column.begin() + static_cast<std::ptrdiff_t>(rowStart[r]), end, c);
  if (place == end || *place != c) return std::nullopt;
  return static_cast<std::size_t>(place - column.begin());
}

void SparseMatrix::append(const SparseRow& row) {
  for (std::size_t i = 0; i < row.value.size(); ++i) {
    if (row.value[i] == 0) continue;
    column.push_back(row.column[i]);
    value.push_back(row.value[i]);
    if (!row.error.empty()) error.push_back(row.error[i]);
  }
  rowStart.push_back(value.size());
}

SparseMatrix matrixOf(std::vector<MatrixEntry> entries, std::size_t rows, std::uint64_t columns,
                      const std::string& file) {
  const auto place = [](const MatrixEntry& entry) { return std::tie(entry.row, entry.column); };
  const auto isBefore = [place](const MatrixEntry& a, const MatrixEntry& b) { return place(a) < place(b); };
  if (!std::is_sorted(entries.begin(), entries.end(), isBefore)) std::sort(entries.begin(), entries.end(), isBefore);
  const auto twice = std::adjacent_find(entries.begin(), entries.end(),
                                        [place](const auto& a, const auto& b) { return place(a) == place(b); });
  if (twice != entries.end()) failTwice(file, twice->row, twice->column);
  constexpr std::uint64_t entryBytes = sizeof(std::uint32_t) + sizeof(double), rowBytes = sizeof(std::uint64_t);
  raster::requireMemory(entries.size() * entryBytes + rows * rowBytes, file, "the matrix");
  SparseMatrix matrix{.columns = columns, .rowStart = std::vector<std::uint64_t>(rows + 1, 0)};
  matrix.column.reserve(entries.size());
  matrix.value.reserve(entries.size());
  for (const MatrixEntry& entry : entries) {
    ++matrix.rowStart[entry.row + std::size_t{1}];
    matrix.column.push_back(entry.column);
    matrix.value.push_back(entry.value);
  }
  std::partial_sum(matrix.rowStart.begin(), matrix.rowStart.end(), matrix.rowStart.begin());
  return matrix;
}

void checkAndSort(SparseMatrix& matrix, const std::string& file) {
  if (matrix.columns >= maxColumns) fail(file, "the matrix has " + std::to_string(matrix.columns) + " columns");
  if (matrix.column.size() != matrix.value.size())
    fail(file, "there are " + std::to_string(matrix.column.size()) + " columns for " +
                   std::to_string(matrix.value.size()) + " values");
  if (!matrix.error.empty() && matrix.error.size() != matrix.value.size())
    fail(file, "there are " + std::to_string(matrix.error.size()) + " errors for " +
                   std::to_string(matrix.value.size()) + " values");
  if (matrix.rowStart.empty() || matrix.rowStart.front() != 0 || matrix.rowStart.back() != matrix.value.size())
    fail(file, "the starts of rows do not lead from 0 to the number of entries");
  if (const auto end = std::is_sorted_until(matrix.rowStart.begin(), matrix.rowStart.end());
      end != matrix.rowStart.end())
    fail(file, "row " + std::to_string(end - matrix.rowStart.begin() - 1) + " ends before it starts");
  for (std::size_t r = 0; r < matrix.rows(); ++r) {
    const std::size_t begin = matrix.rowStart[r], end = matrix.rowStart[r + 1];
    const auto first = matrix.column.begin() + static_cast<std::ptrdiff_t>(begin),
               last = matrix.column.begin() + static_cast<std::ptrdiff_t>(end);
    if (!std::is_sorted(first, last)) sortRow(matrix, begin, end);
    if (const auto twice = std::adjacent_find(first, last); twice != last) failTwice(file, r, *twice);
    if (first != last && *(last - 1) >= matrix.columns)
      fail(file, "row " + std::to_string(r) + " has an entry in column " + std::to_string(*(last - 1)) +
                     ", counted from 0; the matrix has " + std::to_string(matrix.columns) + " columns");
    for (std::size_t i = begin; i < end; ++i)
      if (!std::isfinite(matrix.value[i]))
        fail(file,
             "row " + std::to_string(r) + ", column " + std::to_string(matrix.column[i]) + " is not a finite number");
    if (!matrix.error.empty())
      for (std::size_t i = begin; i < end; ++i)
        if (!std::isfinite(matrix.error[i]) || matrix.error[i] < 0)
          fail(file, "row " + std::to_string(r) + ", column " + std::to_string(matrix.column[i]) +
                         " has an error that is not a finite number of at least 0");
  }
}

MatrixHeading headingOf(std::vector<double> area, const std::vector<std::string>& names) {
  MatrixHeading heading{std::move(area)};
  for (std::size_t f = 0; f < names.size() && heading.names.empty(); ++f)
    if (names[f] != std::to_string(f)) heading.names = names;
  return heading;
}

}  // namespace hemitex::reference
