// Changes between words: as a look at each pair of neighbours tells, with every instruction set.
#include "raster/kernels/run_kernels.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace hemitex;
using raster::Word;

namespace {

std::vector<raster::WordKernels> allKernels() {
  std::vector<raster::WordKernels> all = raster::simdWordKernels();
  all.push_back(raster::plainWordKernels());
  return all;
}

}  // namespace

TEST_CASE("a bit is set where a word differs from the one before it, for rows of every length", "[kernels]") {
  // Runs of 1, 2, 3 ... words, whose highest bit alone differs in every other run.
  std::vector<Word> words{7};
  for (Word run = 0; words.size() < 400; ++run) words.insert(words.end(), run % 9, run % 2 == 0 ? 7U : 0x80000007U);
  for (const raster::WordKernels& kernels : allKernels()) {
    INFO(kernels.name);
    for (std::size_t first = 1; first < 20; ++first)
      for (std::size_t count = 0; count < 300; ++count) {
        const std::size_t numbers = (count + raster::changesAtOnce - 1) / raster::changesAtOnce;
        std::vector<std::uint64_t> expected(numbers), changes(numbers + 1, 0x123);
        for (std::size_t i = 0; i < count; ++i)
          if (words[first + i] != words[first + i - 1]) expected[i / 64] |= std::uint64_t{1} << i % 64;
        kernels.findChanges(words.data() + first, count, changes.data());
        // Nothing is written behind.
        expected.push_back(0x123);
        REQUIRE(changes == expected);
      }
  }
}
