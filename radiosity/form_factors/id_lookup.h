/// From words to slots, where rows are summed: a slot an element, and behind them one for the backs of surfaces and one
/// for the background. A word tells its page by a shift; in a page whose every texel is an element of its own the slot
/// is the word plus a constant, so that no table is read, and where texels share elements (slivers, packed pages) one
/// of its texels is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "raster/interface/item_id.h"

namespace hemitex::radiosity {

class WordSlots {
 public:
  /// Both must outlive this.
  WordSlots(const Discretization& discretization, const WordLayout& layout);

  std::uint32_t back() const { return back_; }
  std::uint32_t background() const { return back_ + 1; }
  std::size_t count() const { return std::size_t{back_} + 2; }

  /// What it takes beside the discretization and the layout.
  std::size_t bytes() const;

 private:
  friend class SlotFinder;

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
  std::vector<Block> blocks_;
  std::vector<std::vector<std::uint32_t>> tables_;  ///< of blocks that no table elsewhere serves
};

/// Looks up words one after the other, most of which lie in the same page as the one before.
class SlotFinder {
 public:
  /// The slots must outlive this.
  explicit SlotFinder(const WordSlots& slots) : slots_(slots) {}

  /// The slot of elementOf; of a word that no element has, the background's.
  std::uint32_t of(raster::Word word) {
    if (word - first_ >= block_.count) [[unlikely]]
      enter(word);
    const std::uint32_t index = word - first_;
    if (index >= block_.count) [[unlikely]]
      return word == slots_.backWord_ ? slots_.back() : slots_.background();
    return block_.slots == nullptr ? block_.first + index : std::min(block_.slots[index], slots_.background());
  }

 private:
  void enter(raster::Word word) {
    const std::uint32_t number = word >> slots_.bits_;
    first_ = number << slots_.bits_;
    block_ = number < slots_.blocks_.size() ? slots_.blocks_[number] : WordSlots::Block{};
  }

  const WordSlots& slots_;
  raster::Word first_ = 0;  ///< of the block
  WordSlots::Block block_;
};

}  // namespace hemitex::radiosity
