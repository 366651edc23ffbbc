/// From words to slots, where rows are summed: a slot an element, and behind them one for the backs of surfaces and one
/// for the background. A word tells its page by a shift; in a page whose every texel is an element of its own the slot
/// is the word plus a constant, so that no table is read, and where texels share elements (slivers, packed pages) one
/// of its texels is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/word_layout.h"
#include "raster/word.h"

namespace hemitex::radiosity {

class WordSlots {
 public:
  /// Both must outlive this.
  WordSlots(const Discretization& discretization, const WordLayout& layout);

  std::uint32_t back() const { return back_; }
  std::uint32_t background() const { return back_ + 1; }
  std::size_t count() const { return std::size_t{back_} + 2; }

  /// The slot of elementOf; of a word that no element has, the background's.
  std::uint32_t of(raster::Word word) const {
    if (const std::uint32_t number = word >> bits_; number < blocks_.size()) {
      const Block& block = blocks_[number];
      if (const std::uint32_t index = word & mask_; index < block.count)
        return block.slots == nullptr ? block.first + index : std::min(block.slots[index], background());
    }
    return word == backWord_ ? back() : background();
  }

  /// What it takes beside the discretization and the layout.
  std::size_t bytes() const;

 private:
  /// The words number * 2^bits_ + [0, count).
  struct Block {
    std::uint32_t count = 0;
    std::uint32_t first = 0;               ///< of the slots, which follow each other; or else
    const std::uint32_t* slots = nullptr;  ///< one a word, noElement where there is none
  };

  void addBlocks(std::size_t words, const std::uint32_t* slots);
  void addPages(const Discretization& discretization, const WordLayout& layout);
  void addSinglePages(const Discretization& discretization, const WordLayout& layout);

  std::uint32_t back_;
  raster::Word backWord_;
  int bits_ = 20;  ///< of a page; where pages do not matter, any number
  std::uint32_t mask_;
  std::vector<Block> blocks_;
  std::vector<std::vector<std::uint32_t>> tables_;  ///< of blocks that no table elsewhere serves
};

}  // namespace hemitex::radiosity
