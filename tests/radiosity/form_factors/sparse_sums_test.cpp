// SparseSums: returns what was added, takes memory only for that, and reuses memory.
#include "radiosity/form_factors/sparse_sums.h"

#include <bit>
#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <utility>
#include <vector>

using hemitex::radiosity::SparseSums;

namespace {

/// Takes all shares, and leaves none.
std::map<std::uint32_t, std::uint64_t> takeShares(SparseSums& sums) {
  std::map<std::uint32_t, std::uint64_t> shares;
  for (std::uint32_t group = 0; group < sums.groups(); ++group)
    for (std::uint32_t i = 0; i < SparseSums::blocksInGroup; ++i) {
      const std::uint32_t number = group * SparseSums::blocksInGroup + i;
      if ((sums.blocksIn(group) >> i & 1) == 0) continue;
      const SparseSums::Block block = sums.find(number).value();
      for (std::uint32_t slot = 0; slot < SparseSums::slotsInBlock; ++slot)
        if ((block.touched >> slot & 1) != 0)
          shares[number * SparseSums::slotsInBlock + slot] = std::exchange(block.shares[slot], 0);
    }
  return shares;
}

void clear(SparseSums& sums) {
  takeShares(sums);
  for (std::size_t group = 0; group < sums.groups(); ++group) sums.clear(group);
  sums.reuse();
}

}  // namespace

TEST_CASE("SparseSums equal the sums of a map, repeatedly", "[rows]") {
  std::mt19937 random(1);
  SparseSums sums(1000003);
  for (int round = 0; round < 20; ++round) {
    std::map<std::uint32_t, std::uint64_t> expected;
    for (std::size_t count = 0; count <= SparseSums::maxAtOnce; count += 256) {
      std::vector<std::uint32_t> slots(count);
      std::vector<std::uint64_t> before{random()};
      for (std::uint32_t& slot : slots) {
        slot = static_cast<std::uint32_t>(random() % 2 == 0 ? random() % 1000003 : 5000 + random() % 100);
        const std::uint64_t share = random() % 4;
        before.push_back(before.back() + share);
        if (share > 0) expected[slot] += share;
      }
      sums.add(slots, before.data());
    }
    CHECK(takeShares(sums) == expected);
    clear(sums);
    CHECK(takeShares(sums).empty());
  }
}

TEST_CASE("SparseSums have blocks only where shares are, and reuse their memory for the next row", "[rows]") {
  // One bit per 4096 slots and one number per 64 are always allocated: 15,626 numbers and 245 groups.
  SparseSums sums(1000002);
  const std::size_t empty = sums.bytes();
  CHECK(empty == 15626 * 4 + 245 * 8);
  const auto fill = [&](std::uint32_t first) {
    std::vector<std::uint32_t> slots;
    std::vector<std::uint64_t> before{0};
    for (std::uint32_t i = 0; i < 100; ++i) {
      slots.push_back(first + 1000 * i);
      before.push_back(i + 1);
    }
    sums.add(slots, before.data());
    std::size_t blocks = 0;
    for (std::size_t group = 0; group < sums.groups(); ++group)
      blocks += static_cast<std::size_t>(std::popcount(sums.blocksIn(group)));
    CHECK(blocks == 100);
    clear(sums);
  };
  fill(0);
  const std::size_t filled = sums.bytes();
  // 64 shares and a bit for each; a growing vector takes at most twice as much as it needs.
  CHECK(filled - empty <= 2 * 100 * 65 * 8);
  fill(777777);
  CHECK(sums.bytes() == filled);
}
