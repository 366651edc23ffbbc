#include "radiosity/geometry/distance_transform.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace hemitex::radiosity {
namespace {

/// Distances are compared as squared distance * scale + index of the texel, so that no two texels are equally near. The
/// scale is above all indices. The largest key, 2 * longestGridSide^2 * scale, is 2^61.
constexpr std::int64_t scale = mostGridTexels;

std::int64_t square(std::int64_t x) { return x * x; }

/// The nearest covered texel of a column, as a function along a row: its key at column c is scale * (c - column)^2 +
/// offset. It is the smallest of all keys from column `start` up to the start of the next candidate.
struct Candidate {
  std::int64_t column = 0;
  std::int64_t offset = 0;
  std::int64_t start = 0;
  std::uint32_t texel = 0;
};

/// The first column at which `right` has a smaller key than `left`; `left.column` is smaller. The difference of the two
/// keys is linear in c.
std::int64_t takesOverAt(const Candidate& left, const Candidate& right) {
  const std::int64_t slope = 2 * scale * (right.column - left.column);
  const std::int64_t lead = right.offset - left.offset + scale * (square(right.column) - square(left.column));
  const std::int64_t quotient = lead / slope - (lead % slope < 0 ? 1 : 0);
  return quotient + 1;
}

/// Adds a candidate right of all others to the lower envelope of a row with `columns` texels.
void addCandidate(std::vector<Candidate>& envelope, Candidate candidate, int columns) {
  while (!envelope.empty()) {
    candidate.start = takesOverAt(envelope.back(), candidate);
    if (candidate.start > envelope.back().start) break;
    envelope.pop_back();
  }
  if (envelope.empty()) candidate.start = 0;
  if (candidate.start < columns) envelope.push_back(candidate);
}

/// For each texel the row of the nearest covered texel in its column; of equals, the lower. -1 if there is none.
std::vector<int> nearestRows(int columns, int rows, const std::vector<bool>& covered) {
  const auto width = static_cast<std::size_t>(columns);
  std::vector<int> nearest(covered.size(), -1);
  for (std::size_t texel = 0; texel < covered.size(); ++texel) {
    if (covered[texel])
      nearest[texel] = static_cast<int>(texel / width);
    else if (texel >= width)
      nearest[texel] = nearest[texel - width];
  }
  std::vector<int> above(width, -1);
  for (int row = rows - 1; row >= 0; --row)
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t texel = static_cast<std::size_t>(row) * width + column;
      if (covered[texel]) above[column] = row;
      const int below = nearest[texel];
      if (above[column] >= 0 && (below < 0 || above[column] - row < row - below)) nearest[texel] = above[column];
    }
  return nearest;
}

}  // namespace

std::vector<std::uint32_t> nearestCovered(int columns, int rows, const std::vector<bool>& covered) {
  assert(std::max(columns, rows) <= longestGridSide && covered.size() <= mostGridTexels);
  assert(std::find(covered.begin(), covered.end(), true) != covered.end());
  const std::vector<int> nearestRow = nearestRows(columns, rows, covered);
  std::vector<std::uint32_t> nearest(covered.size());
  std::vector<Candidate> envelope;
  std::size_t texel = 0;
  for (int row = 0; row < rows; ++row) {
    envelope.clear();
    for (int column = 0; column < columns; ++column) {
      const int other = nearestRow[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                   static_cast<std::size_t>(column)];
      if (other < 0) continue;
      const auto index = static_cast<std::uint32_t>(other * columns + column);
      addCandidate(envelope, {column, scale * square(other - row) + index, 0, index}, columns);
    }
    std::size_t current = 0;
    for (int column = 0; column < columns; ++column, ++texel) {
      while (current + 1 < envelope.size() && envelope[current + 1].start <= column) ++current;
      nearest[texel] = envelope[current].texel;
    }
  }
  return nearest;
}

}  // namespace hemitex::radiosity
