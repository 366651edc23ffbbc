// Runs of a device that sometimes draws other item IDs.
#include "reference/conformance/verdict/repetition.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "reference/conformance/suite/vector_suite.h"

using namespace hemitex;
using reference::RepeatedRuns;
using reference::Repetition;

namespace {

const reference::TestVector& fiveFaces() {
  static const auto vectors = reference::vectorSuite();
  return *std::find_if(vectors.begin(), vectors.end(), [](const auto& vector) { return vector.name == "five-faces"; });
}

/// The runs that differ from the most frequent item IDs, as a share of all.
double differingShare(const Repetition& repetition) {
  const std::uint64_t maxRuns = *std::max_element(repetition.answers.begin(), repetition.answers.end());
  return static_cast<double>(repetition.runs - maxRuns) / static_cast<double>(repetition.runs);
}

}  // namespace

TEST_CASE("RepeatedRuns counts runs by answer and by pixel", "[verdict]") {
  const std::vector<raster::ItemBuffer> right = reference::render(fiveFaces());
  std::vector<raster::ItemBuffer> onePixel = right, twoPixels = right;
  using Answers = std::vector<const std::vector<raster::ItemBuffer>*>;
  const raster::Scissor& scissor = fiveFaces().faces[1].face.scissor;
  onePixel[1].ids[static_cast<std::size_t>(scissor.width) + 2] ^= 1;
  twoPixels[1].ids[static_cast<std::size_t>(scissor.width) + 2] ^= 2;
  twoPixels[4].ids[0] ^= 1;

  RepeatedRuns runs(fiveFaces());
  for (const auto* buffers : Answers{&right, &right, &right}) runs.add(*buffers);
  CHECK(runs.result().isDeterministic());
  CHECK(runs.result().pixels.empty());
  CHECK(differingShare(runs.result()) == 0);
  for (const auto* buffers : Answers{&onePixel, &right, &twoPixels, &onePixel, &right}) runs.add(*buffers);
  const Repetition result = runs.result();
  CHECK_FALSE(result.isDeterministic());
  CHECK(result.runs == 8);
  CHECK(result.answers == std::vector<std::uint64_t>{5, 2, 1});
  CHECK(differingShare(result) == 3.0 / 8);
  REQUIRE(result.pixels.size() == 2);
  CHECK(result.pixels[0].face == fiveFaces().faces[1].name);
  CHECK(result.pixels[0].column == scissor.column + 2);
  CHECK(result.pixels[0].row == scissor.row + 1);
  CHECK(result.pixels[0].runs == 3);
  CHECK(result.pixels[1].runs == 1);
  CHECK(toText(result).find("3 of 8 runs differ from the most frequent item IDs, at 2 pixels: first ") == 0);
}

// A run of a fault with probability 1/100 is missed in 1000 runs with probability 0.99^1000 = 4.3e-5. With this
// generator and these seeds none of 20 devices is missed. The share is binomial: 0.01 with standard deviation 0.0031.
TEST_CASE("A fault in one of a hundred runs is found within a thousand", "[verdict]") {
  const std::vector<raster::ItemBuffer> right = reference::render(fiveFaces());
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    RepeatedRuns runs(fiveFaces());
    std::uint64_t faults = 0;
    for (int run = 0; run < 1000; ++run) {
      std::vector<raster::ItemBuffer> found = right;
      const bool isFaulty = random() % 100 == 0;
      if (isFaulty) found[0].ids[random() % found[0].ids.size()] ^= 1;
      faults += isFaulty;
      runs.add(found);
    }
    INFO(seed);
    CHECK_FALSE(runs.result().isDeterministic());
    CHECK(differingShare(runs.result()) == static_cast<double>(faults) / 1000);
    CHECK(std::abs(differingShare(runs.result()) - 0.01) < 4.5 * 0.0031);
  }
}
