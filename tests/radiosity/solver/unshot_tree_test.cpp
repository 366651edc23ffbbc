// UnshotTree: the results of a pass over all patches, with few visits.
#include "radiosity/solver/unshot_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace hemitex::radiosity;

namespace {

BandTable randomFlux(std::size_t count, std::mt19937& random, std::size_t bands = 3) {
  std::uniform_int_distribution<int> some(-3, 3);
  BandTable flux(count, bands);
  for (double& value : flux.values) value = some(random);
  return flux;
}

void add(UnshotTree& unshot, std::uint32_t patch, std::span<const double> flux) { addTo(unshot.ofPatch(patch), flux); }
void clear(UnshotTree& unshot, std::uint32_t patch) { std::ranges::fill(unshot.ofPatch(patch), 0); }

/// Small integers: their sums are exact in any order, and many are equal.
void checkAgainstAll(const UnshotTree& unshot) {
  const BandTable& flux = unshot.flux();
  Bands sizes(flux.bands == 3 ? 3 : 1);
  std::uint32_t brightest = 0;
  for (std::uint32_t patch = 0; patch < flux.size(); ++patch) {
    for (std::size_t band = 0; band < flux.bands; ++band) sizes[band % sizes.size()] += std::abs(flux[patch][band]);
    if (sizeSum(flux[patch]) > sizeSum(flux[brightest])) brightest = patch;
  }
  CHECK(unshot.brightest() == brightest);
  CHECK(std::ranges::equal(unshot.sizes(), sizes));
}

}  // namespace

TEST_CASE("UnshotTree gives the brightest patch and the sum of sizes of all patches, after any change",
          "[refinement]") {
  std::mt19937 random(5);
  for (const std::size_t count : {1, 2, 63, 64, 65, 4096, 4097, 10000}) {
    INFO(count << " patches");
    const std::size_t bands = count % 2 == 0 ? 3 : 7;
    UnshotTree unshot(randomFlux(count, random, bands));
    checkAgainstAll(unshot);
    for (int round = 0; round < 10; ++round) {
      std::vector<std::uint32_t> blocks;
      const BandTable more = randomFlux(20, random, bands);
      for (std::size_t i = 0; i < more.size(); ++i) {
        const auto patch = static_cast<std::uint32_t>(random() % count);
        add(unshot, patch, more[i]);
        blocks.push_back(patch / UnshotTree::patchesInBlock);
      }
      clear(unshot, unshot.brightest());
      blocks.push_back(unshot.brightest() / UnshotTree::patchesInBlock);
      unshot.update(blocks);
      checkAgainstAll(unshot);
    }
  }
}

TEST_CASE("UnshotTree::brightestPatches lists patches with flux as a sort by size and number does", "[refinement]") {
  std::mt19937 random(11);
  for (const std::size_t patches : {1, 64, 65, 5000}) {
    const BandTable flux = randomFlux(patches, random);
    const auto size = [&](std::uint32_t patch) { return sizeSum(flux[patch]); };
    std::vector<std::uint32_t> sorted;
    for (std::uint32_t patch = 0; patch < patches; ++patch)
      if (size(patch) > 0) sorted.push_back(patch);
    std::stable_sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return size(a) > size(b); });
    for (const std::size_t count : {std::size_t{1}, std::size_t{10}, patches}) {
      std::vector<std::uint32_t> expected = sorted;
      expected.resize(std::min(count, sorted.size()));
      CHECK(UnshotTree(flux).brightestPatches(count) == expected);
    }
  }
}

TEST_CASE("UnshotTree::grow appends patches without flux, and keeps all others", "[refinement]") {
  std::mt19937 random(7);
  for (const std::size_t count : {1, 64, 65, 4096})
    for (const std::size_t larger : {count, count + 1, 64 * count, 64 * count + 1, std::size_t{300'000}}) {
      INFO(count << " patches, then " << larger);
      UnshotTree unshot(randomFlux(count, random));
      unshot.grow(larger);
      CHECK(unshot.flux().size() == larger);
      // The flux of a patch goes on to a new one, as where a patch is split.
      const auto last = static_cast<std::uint32_t>(larger - 1), former = unshot.brightest();
      const Bands flux(unshot.flux()[former].begin(), unshot.flux()[former].end());
      clear(unshot, former);
      add(unshot, last, flux);
      const std::vector<std::uint32_t> blocks{former / UnshotTree::patchesInBlock, last / UnshotTree::patchesInBlock};
      unshot.update(blocks);
      checkAgainstAll(unshot);
    }
}

TEST_CASE("UnshotTree::grow needs an update only of blocks that change", "[refinement]") {
  BandTable flux(2, 3);
  flux.values = {1, 0, 0, 0, 5, 0};
  UnshotTree unshot(flux);
  unshot.grow(65);
  CHECK(unshot.brightest() == 1);
  CHECK(std::ranges::equal(unshot.sizes(), Bands{1, 5, 0}));
}

TEST_CASE("UnshotTree gives the sums of a new tree, to the last bit", "[refinement]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> some(-1, 1);
  BandTable flux(5000, 3);
  for (double& value : flux.values) value = some(random);
  UnshotTree unshot(flux);
  for (int round = 0; round < 100; ++round) {
    const auto patch = static_cast<std::uint32_t>(random() % flux.size());
    const std::uint32_t block = patch / UnshotTree::patchesInBlock;
    add(unshot, patch, Bands{some(random), 1e-9 * some(random), 1e9});
    unshot.update({&block, 1});
  }
  const UnshotTree anew(unshot.flux());
  CHECK(std::ranges::equal(unshot.sizes(), anew.sizes()));
}

TEST_CASE("UnshotTree::update visits 64 patches and 64 nodes per level for one change", "[refinement]") {
  BandTable flux(1 << 18, 3);
  std::ranges::fill(flux.values, 1);
  UnshotTree unshot(flux);
  add(unshot, 77777, Bands{1, 1, 1});
  const std::vector<std::uint32_t> blocks(3, 77777 / 64);
  CHECK(unshot.update(blocks) == 3 * 64);
  CHECK(unshot.brightest() == 77777);
}
