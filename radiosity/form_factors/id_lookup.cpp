#include "radiosity/form_factors/id_lookup.h"

#include <algorithm>

namespace hemitex::radiosity {
namespace {

/// Tables with up to this number of entries stay in the second-level cache.
constexpr std::size_t maxCachedEntries = 65536;

/// Whether texel i is element firstElement + i for all texels.
bool isPlain(const Grid& grid) {
  for (std::uint32_t texel = 0; texel < grid.elementOfTexel.size(); ++texel)
    if (grid.elementOfTexel[texel] != grid.firstElement + texel) return false;
  return true;
}

/// The elements of consecutive item IDs, by elementOf.
std::vector<std::uint32_t> elementsOf(const Discretization& discretization, const IdLayout& layout,
                                      raster::ItemId first, std::uint32_t count) {
  std::vector<std::uint32_t> elements(count);
  for (std::uint32_t i = 0; i < count; ++i)
    elements[i] = elementOf(discretization, layout, first + i).value_or(noElement);
  return elements;
}

}  // namespace

IdLookup::IdLookup(const Discretization& discretization, const IdLayout& layout)
    : back_(static_cast<std::uint32_t>(discretization.elements.size())), backId_(raster::backId(layout.format)) {
  if (layout.indexMaps == IndexMaps::Unique) {
    addBlocks(back_, nullptr);
  } else if (layout.indexMaps == IndexMaps::Packed) {
    addBlocks(layout.packedElements.size(), layout.packedElements.data());
  } else if (!layout.aligned) {
    // Offsets have no gaps.
    std::uint64_t ids = 0;
    for (const Page& page : layout.pages) ids = std::max(ids, page.offset + texelCount(page));
    tables_.push_back(elementsOf(discretization, layout, 0, static_cast<std::uint32_t>(ids)));
    addBlocks(tables_.back().size(), tables_.back().data());
  } else {
    if (layout.textured > 0) bits_ = layout.indexBits;
    addPages(discretization, layout);
    addSinglePages(discretization, layout);
  }
  std::size_t entries = 0;
  for (const Block& block : blocks_) entries += block.slots == nullptr ? 0 : block.count;
  hasLargeTables_ = entries > maxCachedEntries;
}

/// Adds blocks for consecutive item IDs. If `slots` is null, the slots are consecutive from 0 on.
void IdLookup::addBlocks(std::size_t ids, const std::uint32_t* slots) {
  const std::size_t size = std::size_t{1} << bits_;
  for (std::size_t begin = 0; begin < ids; begin += size)
    blocks_.push_back({.count = static_cast<std::uint32_t>(std::min(ids - begin, size)),
                       .first = static_cast<std::uint32_t>(begin),
                       .slots = slots == nullptr ? nullptr : slots + begin});
}

/// Adds one block per page of more than one texel.
void IdLookup::addPages(const Discretization& discretization, const IdLayout& layout) {
  for (std::uint32_t number = 0; number < layout.textured; ++number) {
    const Page& page = layout.pages[layout.byOffset[number]];
    const Grid& grid = discretization.grids[layout.byOffset[number]];
    Block block{.count = static_cast<std::uint32_t>(texelCount(page)), .first = grid.firstElement};
    if (page.columns != grid.columns || page.rows != grid.rows) {
      // Texels behind the grid's last row have no slot.
      block.count = static_cast<std::uint32_t>(page.columns) * static_cast<std::uint32_t>(grid.rows);
      tables_.push_back(elementsOf(discretization, layout, page.offset, block.count));
      block.slots = tables_.back().data();
    } else if (!isPlain(grid)) {
      block.slots = grid.elementOfTexel.data();
    }
    blocks_.push_back(block);
  }
}

/// Adds the pages of one texel, whose item IDs follow.
void IdLookup::addSinglePages(const Discretization& discretization, const IdLayout& layout) {
  const auto singles = static_cast<std::uint32_t>(layout.pages.size()) - layout.textured;
  const auto first = static_cast<raster::ItemId>(blocks_.size() << bits_);
  tables_.push_back(elementsOf(discretization, layout, first, singles));
  addBlocks(singles, tables_.back().data());
}

/// Looks up item IDs one after the other; consecutive item IDs usually lie in the same block.
class IdLookup::Cursor {
 public:
  explicit Cursor(const IdLookup& lookup) : lookup_(lookup) {}

  void prefetch(raster::ItemId id) {
    enter(id);
    const std::uint32_t index = id - first_;
    if (index < block_.count && block_.slots != nullptr) __builtin_prefetch(block_.slots + index);
  }

  std::uint32_t slotOf(raster::ItemId id) {
    enter(id);
    const std::uint32_t index = id - first_;
    if (index >= block_.count) [[unlikely]]
      return id == lookup_.backId_ ? lookup_.back() : lookup_.background();
    return block_.slots == nullptr ? block_.first + index : std::min(block_.slots[index], lookup_.background());
  }

 private:
  void enter(raster::ItemId id) {
    if (id - first_ < block_.count) [[likely]]
      return;
    const std::uint32_t number = id >> lookup_.bits_;
    first_ = number << lookup_.bits_;
    block_ = number < lookup_.blocks_.size() ? lookup_.blocks_[number] : Block{};
  }

  const IdLookup& lookup_;
  raster::ItemId first_ = 0;  ///< of the block
  Block block_;
};

void IdLookup::find(std::span<const raster::ItemId> ids, std::uint32_t* slots) const {
  Cursor ahead(*this), cursor(*this);
  if (hasLargeTables_)
    for (const raster::ItemId id : ids) ahead.prefetch(id);
  for (const raster::ItemId id : ids) *slots++ = cursor.slotOf(id);
}

raster::SlotTable IdLookup::table() const {
  raster::SlotTable table{bits_, backId_, back_};
  for (const Block& block : blocks_) {
    table.blocks.push_back({block.count, block.first});
    if (block.slots == nullptr) continue;
    table.blocks.back().table = static_cast<std::uint32_t>(table.slots.size());
    table.slots.insert(table.slots.end(), block.slots, block.slots + block.count);
  }
  return table;
}

std::size_t IdLookup::bytes() const {
  std::size_t bytes = blocks_.capacity() * sizeof(Block);
  for (const std::vector<std::uint32_t>& table : tables_) bytes += table.capacity() * sizeof(std::uint32_t);
  return bytes;
}

}  // namespace hemitex::radiosity
