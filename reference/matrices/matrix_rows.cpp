#include "reference/matrices/matrix_rows.h"

#include <utility>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

double errorOfEntries(const SparseRow& row, std::size_t facets) {
  double sum = 0;
  for (std::size_t k = 0; k < row.error.size(); ++k)
    if (row.column[k] < facets) sum += row.error[k];
  return sum;
}

MatrixRows::MatrixRows(std::vector<double> area, bool isSmooth, bool isBounded, Take take)
    : facets_(area.size()), take_(std::move(take)) {
  if (isSmooth) smoother_.emplace(std::move(area), isBounded ? 1 : maxStandardErrors);
}

void MatrixRows::add(SparseRow row) {
  for (double& error : row.error) error = asStored(error);
  hasRowErrors_ = hasRowErrors_ || row.rowError;
  const double error = row.rowError.value_or(0);
  if (!smoother_) return take_(row, error);
  measured_.push_back({error, errorOfEntries(row, facets_)});
  smoother_->add(row);
}

std::optional<SmoothingMoves> MatrixRows::finish() {
  if (!smoother_) return std::nullopt;
  const SmoothingMoves moves = smoother_->smooth();
  std::size_t next = 0;
  smoother_->forEachRow([&](const SparseRow& row) {
    const auto& [error, ofEntries] = measured_[next++];
    take_(row, ofEntries > 0 ? error * errorOfEntries(row, facets_) / ofEntries : error);
  });
  return moves;
}

}  // namespace hemitex::reference
