// findChanges equals a comparison of each pair of neighbours, with each instruction set.
#include <catch2/catch.hpp>
#include <vector>

#include "raster/kernels/kernels.h"

using namespace hemitex;
using raster::ItemId;

TEST_CASE("Kernels::findChanges sets a bit where an item ID differs from the one before, for rows of all lengths",
          "[kernels]") {
  // Runs of 1, 2, 3 ... item IDs; every other run differs only in the highest bit.
  std::vector<ItemId> ids{7};
  for (ItemId run = 0; ids.size() < 400; ++run) ids.insert(ids.end(), run % 9, run % 2 == 0 ? 7U : 0x80000007U);
  for (const raster::Kernels& kernels : raster::allKernels()) {
    INFO(kernels.instructionSet);
    for (std::size_t first = 1; first < 20; ++first)
      for (std::size_t count = 0; count < 300; ++count) {
        const std::size_t numbers = (count + raster::changesAtOnce - 1) / raster::changesAtOnce;
        std::vector<std::uint64_t> expected(numbers), changes(numbers + 1, 0x123);
        for (std::size_t i = 0; i < count; ++i)
          if (ids[first + i] != ids[first + i - 1]) expected[i / 64] |= std::uint64_t{1} << i % 64;
        kernels.findChanges(ids.data() + first, count, changes.data());
        // Nothing is written behind the end.
        expected.push_back(0x123);
        REQUIRE(changes == expected);
      }
  }
}
