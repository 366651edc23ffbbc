/// Maps item IDs to slots for summing rows: one slot per element, then one for backs and one for the background. A
/// shift of the item ID gives its page. If each texel of a page is an element of its own, the slot is the item ID plus
/// a constant, without a table. If texels share elements (slivers, packed pages), the page has a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "raster/interface/item_id.h"
#include "raster/interface/pixel_sums.h"

namespace hemitex::radiosity {

class IdLookup {
 public:
  /// Both must outlive this object.
  IdLookup(const Discretization& discretization, const IdLayout& layout);

  std::uint32_t back() const { return back_; }
  std::uint32_t background() const { return back_ + 1; }
  std::size_t count() const { return std::size_t{back_} + 2; }

  /// Writes the slot of each item ID: that of elementOf(id), or the background's if no element has the item ID. Many
  /// item IDs at once are faster, because the cache misses of their tables overlap.
  void find(std::span<const raster::ItemId> ids, std::uint32_t* slots) const;
  /// The same rules as plain arrays.
  raster::SlotTable table() const;

  /// Memory in addition to the discretization and the layout.
  std::size_t bytes() const;

 private:
  class Cursor;

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
  bool hasLargeTables_ = false;  ///< the tables of all blocks together; then find() prefetches their entries
  std::vector<std::vector<std::uint32_t>> tables_;  ///< tables of blocks that no other structure provides
};

}  // namespace hemitex::radiosity
