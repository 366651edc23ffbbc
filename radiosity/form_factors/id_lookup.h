/// Maps item IDs to slots for summing rows: one slot per element, then one for backs and one for the background. A
/// shift of the item ID gives its page. If each texel of a page is an element of its own, the slot is the item ID plus
/// a constant, without a table. If texels share elements (slivers, packed pages), the page has a table.
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
  /// Both must outlive this object.
  IdLookup(const Discretization& discretization, const IdLayout& layout);

  std::uint32_t back() const { return back_; }
  std::uint32_t background() const { return back_ + 1; }
  std::size_t count() const { return std::size_t{back_} + 2; }

  /// Memory in addition to the discretization and the layout.
  std::size_t bytes() const;

 private:
  friend class SlotFinder;

  /// The item IDs number * 2^bits_ + [0, count).
  struct Block {
    std::uint32_t count = 0;
    std::uint32_t first = 0;               ///< first of consecutive slots, if `slots` is null
    const std::uint32_t* slots = nullptr;  ///< one per item ID; noElement for none
  };

  void addBlocks(std::size_t ids, const std::uint32_t* slots);
  void addPages(const Discretization& discretization, const IdLayout& layout);
  void addSinglePages(const Discretization& discretization, const IdLayout& layout);

  std::uint32_t back_;
  raster::ItemId backId_;
  int bits_ = 20;  ///< bits of a page; any number if there is one block for all pages
  std::vector<Block> blocks_;
  std::vector<std::vector<std::uint32_t>> tables_;  ///< tables of blocks that no other structure provides
};

/// Looks up item IDs one after the other; consecutive item IDs usually lie in the same page.
class SlotFinder {
 public:
  /// The slots must outlive this object.
  explicit SlotFinder(const IdLookup& slots) : slots_(slots) {}

  /// The slot of elementOf(id); the background's slot if no element has the item ID.
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
