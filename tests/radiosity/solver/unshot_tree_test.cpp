// UnshotTree: the results of a pass over all patches, with few visits.
#include "radiosity/solver/unshot_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "radiosity/scene/scene.h"

using namespace hemitex::radiosity;

namespace {

std::vector<glm::dvec3> randomFlux(std::size_t count, std::mt19937& random) {
  std::uniform_int_distribution<int> some(-3, 3);
  std::vector<glm::dvec3> flux(count);
  for (glm::dvec3& f : flux) f = {some(random), some(random), some(random)};
  return flux;
}

/// Small integers: their sums are exact in any order, and many are equal.
void checkAgainstAll(const UnshotTree& unshot) {
  glm::dvec3 sizes(0);
  std::uint32_t brightest = 0;
  for (std::uint32_t patch = 0; patch < unshot.flux().size(); ++patch) {
    sizes += glm::abs(unshot.flux()[patch]);
    if (bandSum(glm::abs(unshot.flux()[patch])) > bandSum(glm::abs(unshot.flux()[brightest]))) brightest = patch;
  }
  CHECK(unshot.brightest() == brightest);
  CHECK(unshot.sizes() == sizes);
}

}  // namespace

TEST_CASE("UnshotTree gives the brightest patch and the sum of sizes of all patches, after any change",
          "[refinement]") {
  std::mt19937 random(5);
  for (const std::size_t count : {1, 2, 63, 64, 65, 4096, 4097, 10000}) {
    INFO(count << " patches");
    UnshotTree unshot(randomFlux(count, random));
    checkAgainstAll(unshot);
    for (int round = 0; round < 10; ++round) {
      std::vector<std::uint32_t> blocks;
      for (const glm::dvec3& more : randomFlux(20, random)) {
        const auto patch = static_cast<std::uint32_t>(random() % count);
        unshot.add(patch, more);
        blocks.push_back(patch / UnshotTree::patchesInBlock);
      }
      unshot.clear(unshot.brightest());
      blocks.push_back(unshot.brightest() / UnshotTree::patchesInBlock);
      unshot.update(blocks);
      checkAgainstAll(unshot);
    }
  }
}

TEST_CASE("UnshotTree::brightestPatches lists patches with flux as a sort by size and number does", "[refinement]") {
  std::mt19937 random(11);
  for (const std::size_t patches : {1, 64, 65, 5000}) {
    const std::vector<glm::dvec3> flux = randomFlux(patches, random);
    const auto size = [&](std::uint32_t patch) { return bandSum(glm::abs(flux[patch])); };
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
      const glm::dvec3 flux = unshot.flux()[former];
      unshot.clear(former);
      unshot.add(last, flux);
      const std::vector<std::uint32_t> blocks{former / UnshotTree::patchesInBlock, last / UnshotTree::patchesInBlock};
      unshot.update(blocks);
      checkAgainstAll(unshot);
    }
}

TEST_CASE("UnshotTree::grow needs an update only of blocks that change", "[refinement]") {
  UnshotTree unshot({{1, 0, 0}, {0, 5, 0}});
  unshot.grow(65);
  CHECK(unshot.brightest() == 1);
  CHECK(unshot.sizes() == glm::dvec3(1, 5, 0));
}

TEST_CASE("UnshotTree gives the sums of a new tree, to the last bit", "[refinement]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> some(-1, 1);
  std::vector<glm::dvec3> flux(5000);
  for (glm::dvec3& f : flux) f = {some(random), some(random), some(random)};
  UnshotTree unshot(flux);
  for (int round = 0; round < 100; ++round) {
    const auto patch = static_cast<std::uint32_t>(random() % flux.size());
    const std::uint32_t block = patch / UnshotTree::patchesInBlock;
    unshot.add(patch, {some(random), 1e-9 * some(random), 1e9});
    unshot.update({&block, 1});
  }
  CHECK(unshot.sizes() == UnshotTree(unshot.flux()).sizes());
}

TEST_CASE("UnshotTree::update visits 64 patches and 64 nodes per level for one change", "[refinement]") {
  UnshotTree unshot(std::vector<glm::dvec3>(1 << 18, glm::dvec3(1)));
  unshot.add(77777, glm::dvec3(1));
  const std::vector<std::uint32_t> blocks(3, 77777 / 64);
  CHECK(unshot.update(blocks) == 3 * 64);
  CHECK(unshot.brightest() == 77777);
}
