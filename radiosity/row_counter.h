/// Counts item buffers into rows: words to elements through the layout and the spill tables, pixels to shares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/form_factors.h"
#include "radiosity/projection.h"
#include "radiosity/word_layout.h"
#include "raster/face.h"

namespace hemitex::radiosity {

class RowCounter {
 public:
  /// Both referenced objects must outlive this one.
  RowCounter(const Discretization& discretization, const WordLayout& layout);

  /// Adds the words of a window of one of the projection's faces. It lies inside that face's scissor rectangle, and is
  /// all of it for a whole row; drawing a face with a smaller scissor rectangle gives the same words there.
  void add(const Projection& projection, std::size_t face, const raster::Scissor& window,
           const raster::ItemBuffer& buffer);

  /// What was added since the last time.
  FormFactorRow take();

 private:
  /// Where a word is counted: at an element, or behind them at the two that follow.
  std::uint32_t slotOf(raster::Word word) const;
  std::uint32_t backSlot() const { return static_cast<std::uint32_t>(discretization_.elements.size()); }
  std::uint32_t backgroundSlot() const { return backSlot() + 1; }

  const Discretization& discretization_;
  const WordLayout& layout_;
  std::vector<std::uint32_t> slots_;   ///< of the lowest words: a pixel costs the same whatever it shows
  std::vector<std::uint64_t> share_;   ///< one a slot, all 0 between rows
  std::vector<std::uint8_t> touched_;  ///< one for every eight slots, not 0 where one of them may have a share
  FormFactorRow row_;                  ///< the last one: its memory serves the next
};

}  // namespace hemitex::radiosity
