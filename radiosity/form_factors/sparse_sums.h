/// Sparse sums of shares by slot. Blocks of 64 slots are allocated when one of their slots receives a share. So
/// invisible slots take almost no time or memory: one bit per 4096 slots to test, and one number per 64 slots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hemitex::radiosity {

class SparseSums {
 public:
  static constexpr std::uint32_t slotsInBlock = 64;
  static constexpr std::uint32_t blocksInGroup = 64;

  struct Block {
    std::uint64_t touched = 0;  ///< bit i: slot i has a share
    std::array<std::uint64_t, slotsInBlock> shares = {};

    /// Returns the share of a slot and resets it.
    std::uint64_t take(std::uint32_t slot) { return std::exchange(shares[slot], 0); }
  };

  /// `slots` is the number of slots.
  explicit SparseSums(std::size_t slots);

  void add(std::uint32_t slot, std::uint64_t share) {
    const std::uint32_t number = slot / slotsInBlock, place = slot % slotsInBlock;
    if (placeOf_[number] == none) addBlock(number);
    Block& block = blocks_[placeOf_[number]];
    block.shares[place] += share;
    block.touched |= std::uint64_t{share != 0} << place;
  }

  std::size_t groups() const { return groups_.size(); }
  /// Bit i: block group * 64 + i is allocated.
  std::uint64_t blocksIn(std::size_t group) const { return groups_[group]; }
  /// A block, or null.
  Block* find(std::uint32_t number) { return placeOf_[number] == none ? nullptr : &blocks_[placeOf_[number]]; }

  /// Removes the blocks of a group whose shares are all taken. Different groups may be cleared at the same time.
  void clear(std::size_t group);
  /// Makes the memory of removed blocks available. Call it after all groups are cleared.
  void reuse();
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  void addBlock(std::uint32_t number);

  std::vector<std::uint64_t> groups_;
  std::vector<std::uint32_t> placeOf_;  ///< of each block in `blocks_`, or none
  std::vector<Block> blocks_;           ///< in order of allocation; those from `used_` on are all 0
  std::uint32_t used_ = 0;
};

}  // namespace hemitex::radiosity
