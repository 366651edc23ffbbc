#include "radiosity/form_factors/sparse_sums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

namespace hemitex::radiosity {
namespace {

std::size_t dividedUp(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

}  // namespace

SparseSums::SparseSums(std::size_t slots)
    : groups_(dividedUp(slots, slotsInBlock * blocksInGroup)), placeOf_(dividedUp(slots, slotsInBlock), none) {}

std::uint32_t SparseSums::addBlock(std::uint32_t number) {
  if (used_ == touched_.size()) {
    touched_.push_back(0);
    shares_.resize(shares_.size() + slotsInBlock);
  }
  groups_[number / blocksInGroup] |= std::uint64_t{1} << number % blocksInGroup;
  return placeOf_[number] = used_++;
}

void SparseSums::add(std::span<const std::uint32_t> slots, const std::uint64_t* before) {
  assert(slots.size() <= maxAtOnce);
  std::array<std::uint32_t, maxAtOnce> places;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::uint32_t number = slots[i] / slotsInBlock, slot = slots[i] % slotsInBlock;
    const std::uint32_t block = placeOf_[number] == none ? addBlock(number) : placeOf_[number];
    touched_[block] |= std::uint64_t{before[i] != before[i + 1]} << slot;
    places[i] = block * slotsInBlock + slot;
    __builtin_prefetch(&shares_[places[i]], 1);
  }
  for (std::size_t i = 0; i < slots.size(); ++i) shares_[places[i]] += before[i + 1] - before[i];
}

void SparseSums::clear(std::size_t group) {
  for (std::uint64_t blocks = std::exchange(groups_[group], 0); blocks != 0; blocks &= blocks - 1) {
    const std::size_t number = group * blocksInGroup + static_cast<std::size_t>(std::countr_zero(blocks));
    touched_[std::exchange(placeOf_[number], none)] = 0;
  }
}

void SparseSums::reuse() {
  assert(std::all_of(groups_.begin(), groups_.end(), [](std::uint64_t blocks) { return blocks == 0; }));
  used_ = 0;
}

std::size_t SparseSums::bytes() const {
  return groups_.capacity() * sizeof(groups_[0]) + placeOf_.capacity() * sizeof(placeOf_[0]) +
         (touched_.capacity() + shares_.capacity()) * sizeof(std::uint64_t);
}

}  // namespace hemitex::radiosity
