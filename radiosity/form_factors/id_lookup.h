/// From item IDs to slots, where rows are summed: a slot an element, and behind them one for the backs of surfaces and
/// one for the background. An item ID tells its page by a shift; in a page whose every texel is an element of its own
/// the slot is the item ID plus a constant, so that no table is read, and where texels share elements (slivers, packed
/// pages) one of its texels is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "raster/interface/item_id.h"

namespace hemitex::radiosity {

class IdLookup {
 public:
  /// Both must outlive this.
  IdLookup(const Discretization& discretization, const IdLayout& layout);

  std::uint32_t back() const { return back_; }
  std::uint32_t background() const { return back_ + 1; }
  std::size_t count() const { return std::size_t{back_} + 2; }

  /// What it takes beside the discretization and the layout.
  std::size_t bytes() const;

 private:
  friend class SlotFinder;

  /// The item IDs number * 2^bits_ + [0, count).
  struct Block {
    std::uint32_t count = 0;
    std::uint32_t first = 0;               ///< of the slots, which follow each other; or else
    const std::uint32_t* slots = nullptr;  ///< one an item ID, noElement where there is none
  };

  void addBlocks(std::size_t ids, const std::uint32_t* slots);
  void addPages(const Discretization& discretization, const IdLayout& layout);
  void addSinglePages(const Discretization& discretization, const IdLayout& layout);

  std::uint32_t back_;
  raster::ItemId backId_;
  int bits_ = 20;  ///< of a page; where pages do not matter, any number
  std::vector<Block> blocks_;
  std::vector<std::vector<std::uint32_t>> tables_;  ///< of blocks that no table elsewhere serves
};

/// Looks up item IDs one after the other, most of which lie in the same page as the one before.
class SlotFinder {
 public:
  /// The slots must outlive this.
  explicit SlotFinder(const IdLookup& slots) : slots_(slots) {}

  /// The slot of elementOf; of an item ID that no element has, the background's.
  std::uint32_t of(raster::ItemId id) {
    if (id - first_ >= block_.count) [[unlikely]]
      enter(id);
    const std::uint32_t index = id - first_;
    if (index >= block_.count) [[unlikely]]
      return id == slots_.backId_ ? slots_.back() : slots_.background();
    return block_.slots == nullptr ? block_.first + index : std::min(block_.slots[index], slots_.background());
  }

 private:
  void enter(raster::ItemId id) {
    const std::uint32_t number = id >> slots_.bits_;
    first_ = number << slots_.bits_;
    block_ = number < slots_.blocks_.size() ? slots_.blocks_[number] : IdLookup::Block{};
  }

  const IdLookup& slots_;
  raster::ItemId first_ = 0;  ///< of the block
  IdLookup::Block block_;
};

}  // namespace hemitex::radiosity
