#include "reference/matrices/measured_twice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

MeasuredTwice::MeasuredTwice(std::vector<double> area) : area_(std::move(area)), missed_(area_.size(), 0.0) {}

void MeasuredTwice::add(const SparseRow& row) {
  const auto number = static_cast<std::uint32_t>(firstOf_.size() - 1);
  for (std::size_t k = 0; k < row.error.size() && row.column[k] < area_.size(); ++k)
    measurements_.push_back(
        {row.column[k], static_cast<float>(row.error[k] * area_[number]), row.value[k] * area_[number]});
  firstOf_.push_back(measurements_.size());
  if (firstOf_.size() <= area_.size()) return;
  for (std::uint32_t r = 0; r < area_.size(); ++r)
    for (std::size_t m = firstOf_[r]; m < firstOf_[r + std::size_t{1}]; ++m) {
      const auto& [column, error, flux] = measurements_[m];
      if (flux > static_cast<double>(error) && find(column, r) == nullptr) missed_[column] += flux;
    }
}

/// The measurement of an entry by its own row; null if the row has no such entry.
const MeasuredTwice::Measurement* MeasuredTwice::find(std::uint32_t row, std::uint32_t column) const {
  const Measurement *begin = measurements_.data() + firstOf_[row],
                    *end = measurements_.data() + firstOf_[row + std::size_t{1}];
  const Measurement* found =
      std::lower_bound(begin, end, column, [](const Measurement& m, std::uint32_t c) { return m.column < c; });
  return found != end && found->column == column ? found : nullptr;
}

void MeasuredTwice::widen(std::uint32_t number, SparseRow& row) const {
  if (row.error.empty()) return;
  double added = missed_[number] / area_[number];
  for (std::size_t k = 0; k < row.column.size() && row.column[k] < area_.size(); ++k) {
    const Measurement* other = find(row.column[k], number);
    const double difference = std::abs(row.value[k] - (other ? other->flux / area_[number] : 0));
    if (difference <= row.error[k] + (other ? static_cast<double>(other->error) / area_[number] : 0)) continue;
    added += difference - row.error[k];
    row.error[k] = asStored(difference);
  }
  if (row.rowError) *row.rowError += added;
}

}  // namespace hemitex::reference
