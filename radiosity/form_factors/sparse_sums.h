/// Sums of shares in many slots, of which few have any: blocks of 64 slots are there where one of them got a share. So
/// neither time nor memory goes into what a point does not see, but for a look at one bit in 4096 slots and a number
/// for every 64.
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

    /// The share of a slot, which has none afterwards.
    std::uint64_t take(std::uint32_t slot) { return std::exchange(shares[slot], 0); }
  };

  /// Slots are below `slots`.
  explicit SparseSums(std::size_t slots);

  void add(std::uint32_t slot, std::uint64_t share) {
    const std::uint32_t number = slot / slotsInBlock, place = slot % slotsInBlock;
    if (placeOf_[number] == none) addBlock(number);
    Block& block = blocks_[placeOf_[number]];
    block.shares[place] += share;
    block.touched |= std::uint64_t{share != 0} << place;
  }

  std::size_t groups() const { return groups_.size(); }
  /// Bit i: block group * 64 + i is there.
  std::uint64_t blocksIn(std::size_t group) const { return groups_[group]; }
  /// A block; null where it is not there.
  Block* find(std::uint32_t number) { return placeOf_[number] == none ? nullptr : &blocks_[placeOf_[number]]; }

  /// Forgets the blocks of a group, all of whose shares were taken; groups may be cleared at the same time.
  void clear(std::size_t group);
  /// To be called when all groups are clear: their blocks' memory serves others.
  void reuse();
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  void addBlock(std::uint32_t number);

  std::vector<std::uint64_t> groups_;
  std::vector<std::uint32_t> placeOf_;  ///< of each block in `blocks_`, or none
  std::vector<Block> blocks_;           ///< in the order in which they came; those from `used_` on are all 0
  std::uint32_t used_ = 0;
};

}  // namespace hemitex::radiosity
