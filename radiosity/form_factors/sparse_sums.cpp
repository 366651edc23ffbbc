#include "radiosity/form_factors/sparse_sums.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace hemitex::radiosity {
namespace {

std::size_t dividedUp(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

}  // namespace

SparseSums::SparseSums(std::size_t slots)
    : groups_(dividedUp(slots, slotsInBlock * blocksInGroup)), placeOf_(dividedUp(slots, slotsInBlock), none) {}

void SparseSums::addBlock(std::uint32_t number) {
  if (used_ == blocks_.size()) blocks_.emplace_back();
  placeOf_[number] = used_++;
  groups_[number / blocksInGroup] |= std::uint64_t{1} << number % blocksInGroup;
}

void SparseSums::clear(std::size_t group) {
  for (std::uint64_t blocks = std::exchange(groups_[group], 0); blocks != 0; blocks &= blocks - 1) {
    const std::size_t number = group * blocksInGroup + static_cast<std::size_t>(std::countr_zero(blocks));
    blocks_[std::exchange(placeOf_[number], none)].touched = 0;
  }
}

void SparseSums::reuse() {
  assert(std::all_of(groups_.begin(), groups_.end(), [](std::uint64_t blocks) { return blocks == 0; }));
  used_ = 0;
}

std::size_t SparseSums::bytes() const {
  return groups_.capacity() * sizeof(groups_[0]) + placeOf_.capacity() * sizeof(placeOf_[0]) +
         blocks_.capacity() * sizeof(Block);
}

}  // namespace hemitex::radiosity
