/// Sparse sums of shares by slot. Blocks of 64 slots are allocated when one of their slots receives a share. So
/// invisible slots take almost no time or memory: one bit per 4096 slots to test, and one number per 64 slots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemitex::radiosity {

class SparseSums {
 public:
  static constexpr std::uint32_t slotsInBlock = 64;
  static constexpr std::uint32_t blocksInGroup = 64;

  /// Shares of a block.
  struct Block {
    std::uint64_t touched;  ///< bit i: slot i has a share
    std::uint64_t* shares;  ///< one per slot
  };

  /// `slots` is the number of slots.
  explicit SparseSums(std::size_t slots);

  static constexpr std::size_t maxAtOnce = 1025;
  /// Adds the share before[i + 1] - before[i] to slots[i], for up to maxAtOnce slots. Many slots at once are faster,
  /// because their cache misses overlap.
  void add(std::span<const std::uint32_t> slots, const std::uint64_t* before);

  std::size_t groups() const { return groups_.size(); }
  /// Bit i: block group * 64 + i is allocated.
  std::uint64_t blocksIn(std::size_t group) const { return groups_[group]; }
  /// A block, if it is allocated. Who takes a share sets it to 0.
  std::optional<Block> find(std::uint32_t number) {
    const std::uint32_t place = placeOf_[number];
    if (place == none) return std::nullopt;
    return Block{touched_[place], shares_.data() + std::size_t{place} * slotsInBlock};
  }

  /// Removes the blocks of a group whose shares are all taken. Different groups may be cleared at the same time.
  void clear(std::size_t group);
  /// Makes the memory of removed blocks available. Call it after all groups are cleared.
  void reuse();
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Returns the block's place.
  std::uint32_t addBlock(std::uint32_t number);

  std::vector<std::uint64_t> groups_;
  std::vector<std::uint32_t> placeOf_;  ///< of each block in `touched_` and `shares_`, or none
  // In order of allocation; those from place `used_` on are all 0.
  std::vector<std::uint64_t> touched_;  ///< see Block
  std::vector<std::uint64_t> shares_;   ///< slotsInBlock per block
  std::uint32_t used_ = 0;
};

}  // namespace hemitex::radiosity
