#include "radiosity/row_counter.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hemitex::radiosity {

namespace {

/// Words above have no slot at hand: a table of all would be large where surfaces are many.
constexpr std::size_t mostSlots = std::size_t{1} << 22;
constexpr std::uint32_t slotsAtOnce = 8;

/// The words that may be drawn, but for the reserved ones; none where words are those of unique maps.
std::size_t wordCount(const WordLayout& layout) {
  std::size_t count = layout.packedElements.size();
  for (const Page& page : layout.pages)
    count = std::max(count, static_cast<std::size_t>(page.offset) +
                                static_cast<std::size_t>(page.columns) * static_cast<std::size_t>(page.rows));
  return count;
}

}  // namespace

RowCounter::RowCounter(const Discretization& discretization, const WordLayout& layout)
    : discretization_(discretization),
      layout_(layout),
      slots_(std::min(mostSlots, wordCount(layout))),
      share_(discretization.elements.size() + 2),
      touched_(share_.size() / slotsAtOnce + 1) {
  for (std::size_t word = 0; word < slots_.size(); ++word) slots_[word] = slotOf(static_cast<raster::Word>(word));
}

std::uint32_t RowCounter::slotOf(raster::Word word) const {
  if (word == raster::backWord(layout_.format)) return backSlot();
  return elementOf(discretization_, layout_, word).value_or(backgroundSlot());
}

void RowCounter::add(const Projection& projection, std::size_t face, const raster::Scissor& window,
                     const raster::ItemBuffer& buffer) {
  const raster::Scissor& whole = projection.faces[face].scissor;
  assert(buffer.width == window.width && buffer.height == window.height);
  assert(window.column >= whole.column && window.column + window.width <= whole.column + whole.width);
  assert(window.row >= whole.row && window.row + window.height <= whole.row + whole.height);
  if (buffer.words.empty()) return;
  const std::uint64_t* const shares = projection.shares[projection.faces[face].shares].data();
  const raster::Word* word = buffer.words.data();
  for (int j = 0; j < window.height; ++j) {
    const std::uint64_t* share =
        shares + static_cast<std::ptrdiff_t>(window.row - whole.row + j) * whole.width + (window.column - whole.column);
    for (int i = 0; i < window.width; ++i, ++word, ++share) {
      const std::uint32_t slot = *word < slots_.size() ? slots_[*word] : slotOf(*word);
      share_[slot] += *share;
      touched_[slot / slotsAtOnce] = 1;
    }
  }
}

FormFactorRow RowCounter::take() {
  row_.elements.clear();
  row_.shares.clear();
  row_.back = std::exchange(share_[backSlot()], 0);
  row_.background = std::exchange(share_[backgroundSlot()], 0);
  for (std::uint32_t block = 0; block < touched_.size(); ++block) {
    if (std::exchange(touched_[block], std::uint8_t{0}) == 0) continue;
    const std::uint32_t first = block * slotsAtOnce, end = std::min(first + slotsAtOnce, backSlot());
    for (std::uint32_t element = first; element < end; ++element)
      if (const std::uint64_t share = std::exchange(share_[element], 0); share != 0) {
        row_.elements.push_back(element);
        row_.shares.push_back(share);
      }
  }
  return row_;
}

}  // namespace hemitex::radiosity
