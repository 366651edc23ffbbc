// batchesOf needs no device: vertices and runs per call.
#include "reference/devices/batches.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace hemitex;
using reference::batchesOf;

namespace {

/// Draws of 4, 2 and 3 triangles, whose vertices lie in the buffers as 0 to 11, 12 to 17 and 18 to 26.
raster::DrawList threeDraws() {
  raster::DrawList list;
  list.indices.resize(27);
  list.draws = {{.first = 0, .count = 12, .back = {}},
                {.first = 12, .count = 6, .back = {}},
                {.first = 18, .count = 9, .back = {}}};
  return list;
}

std::vector<int> verticesOf(const std::vector<reference::DrawBatch>& batches) {
  std::vector<int> vertices;
  for (const reference::DrawBatch& batch : batches)
    for (std::size_t run = 0; run < batch.runs.first.size(); ++run)
      for (int k = 0; k < batch.runs.count[run]; ++k) vertices.push_back(batch.runs.first[run] + k);
  return vertices;
}

bool always(const raster::Draw&, const raster::Draw&) { return true; }
bool never(const raster::Draw&, const raster::Draw&) { return false; }

}  // namespace

TEST_CASE("batchesOf has each vertex that is not skipped once and in order, for any skipped triangles and joins",
          "[devices]") {
  const raster::DrawList list = threeDraws();
  for (std::uint32_t set = 0; set < 1u << 9; ++set) {
    std::vector<std::uint32_t> skipped;
    std::vector<int> left;
    for (std::uint32_t triangle = 0; triangle < 9; ++triangle) {
      if (set >> triangle & 1) {
        skipped.push_back(triangle);
        continue;
      }
      for (int k = 0; k < 3; ++k) left.push_back(static_cast<int>(3 * triangle) + k);
    }
    REQUIRE(verticesOf(batchesOf(list, skipped, always)) == left);
    REQUIRE(verticesOf(batchesOf(list, skipped, never)) == left);
  }
}

TEST_CASE("batchesOf makes one batch of draws that join, with one run that is cut at skipped triangles", "[devices]") {
  const raster::DrawList list = threeDraws();
  const auto whole = batchesOf(list, {}, always);
  REQUIRE(whole.size() == 1);
  CHECK(whole[0].draw == &list.draws[0]);
  CHECK(whole[0].runs.first == std::vector<int>{0});
  CHECK(whole[0].runs.count == std::vector<int>{27});

  // Triangle 4 has the vertices 12 to 14.
  const std::vector<std::uint32_t> skipped{4};
  const auto cut = batchesOf(list, skipped, always);
  REQUIRE(cut.size() == 1);
  CHECK(cut[0].runs.first == std::vector<int>{0, 15});
  CHECK(cut[0].runs.count == std::vector<int>{12, 12});

  const auto apart = batchesOf(list, skipped, never);
  REQUIRE(apart.size() == 3);
  CHECK(apart[1].draw == &list.draws[1]);
  CHECK(apart[1].runs.first == std::vector<int>{15});
}

TEST_CASE("batchesOf numbers the vertices draw after draw, wherever their triangles are in the list", "[devices]") {
  raster::DrawList list = threeDraws();
  std::swap(list.draws[0], list.draws[2]);  // triangles 6 to 8 are vertices 0 to 8
  const std::vector<std::uint32_t> skipped{0, 7};
  // Triangle 7 is vertices 3 to 5; triangle 0, the first of the last draw, is vertices 15 to 17.
  const auto batches = batchesOf(list, skipped, always);
  REQUIRE(batches.size() == 1);
  CHECK(batches[0].runs.first == std::vector<int>{0, 6, 18});
  CHECK(batches[0].runs.count == std::vector<int>{3, 9, 9});
}
