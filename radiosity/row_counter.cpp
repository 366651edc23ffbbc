#include "radiosity/row_counter.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hemitex::radiosity {

RowCounter::RowCounter(const Discretization& discretization, const WordLayout& layout)
    : discretization_(discretization), layout_(layout), share_(discretization.elements.size()) {}

void RowCounter::add(raster::Word word, std::uint64_t share) {
  if (share == 0) return;  // below the horizon
  if (word == raster::backWord(layout_.format)) {
    row_.back += share;
  } else if (const auto element = elementOf(discretization_, layout_, word)) {
    if (share_[*element] == 0) row_.elements.push_back(*element);
    share_[*element] += share;
  } else {
    row_.background += share;
  }
}

void RowCounter::add(const Projection& projection, std::size_t face, const raster::Scissor& window,
                     const raster::ItemBuffer& buffer) {
  const raster::Scissor& whole = projection.faces[face].scissor;
  assert(buffer.width == window.width && buffer.height == window.height);
  assert(window.column >= whole.column && window.column + window.width <= whole.column + whole.width);
  assert(window.row >= whole.row && window.row + window.height <= whole.row + whole.height);
  if (buffer.words.empty()) return;
  const std::uint64_t* const shares = projection.shares[projection.faces[face].shares].data();
  // Neighbouring pixels mostly show the same element: their shares are added before the word is looked up.
  raster::Word run = buffer.words.front();
  std::uint64_t sum = 0;
  const raster::Word* word = buffer.words.data();
  for (int j = 0; j < window.height; ++j) {
    const std::uint64_t* share =
        shares + static_cast<std::ptrdiff_t>(window.row - whole.row + j) * whole.width + (window.column - whole.column);
    for (int i = 0; i < window.width; ++i, ++word, ++share) {
      if (*word != run) {
        add(run, sum);
        run = *word;
        sum = 0;
      }
      sum += *share;
    }
  }
  add(run, sum);
}

FormFactorRow RowCounter::take() {
  FormFactorRow row = std::exchange(row_, {});
  std::sort(row.elements.begin(), row.elements.end());
  for (const std::uint32_t element : row.elements) row.shares.push_back(std::exchange(share_[element], 0));
  return row;
}

}  // namespace hemitex::radiosity
