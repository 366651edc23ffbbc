// Version 2 of the rules beside holes and culling: triangle numbers, depth tests, viewports and sample places.
#include <algorithm>
#include <catch2/catch.hpp>

#include "raster/base/input_error.h"
#include "raster/plain/plain_renderer.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;
using raster::DepthTest;
using raster::DrawList;
using raster::Face;
using raster::ItemId;
using raster::PixelValue;

namespace {

std::vector<ItemId> drawnPlainly(const DrawList& list, const Face& face) {
  return render(raster::PlainRenderer(list), {&face, 1}).front().ids;
}

/// crossingTriangles between the near plane and 8 units away, inside the guard band.
DrawList triangleInFront() {
  DrawList list = crossingTriangles();
  for (glm::vec3& position : list.positions) position.z = std::max(position.z + 2, 1.0F);
  return list;
}

/// Triangles of one plane seen straight on, in draws of their own, with corners on a grid of 1/64 of the picture.
DrawList gridTriangles() {
  std::mt19937 random(6);
  DrawList list = plainList();
  list.indexMaps.push_back(countingMap(9, 5));
  const auto onGrid = [&] { return static_cast<float>(static_cast<int>(random() % 160) - 80) / 64; };
  for (ItemId draw = 0; draw < 30; ++draw) {
    addDraw(list, draw << 8, {}, 0);
    const auto point = [&] { return glm::vec3{onGrid(), onGrid(), 1}; };
    const glm::vec3 a = point(), b = point(), c = point();
    addTriangle(list, {a, b, c}, {{0, 0}, {1, 0.1F}, {0.3F, 0.9F}});
  }
  return list;
}

}  // namespace

TEST_CASE("PlainRenderer and SoftwareRenderer give each triangle its number in its draw", "[numbers]") {
  for (DrawList list : {crossingTriangles(), smallTriangles(300)}) {
    list.value = PixelValue::TriangleNumbers;
    // One draw per triangle whose item ID is the number.
    DrawList each = list;
    each.value = PixelValue::ItemIds;
    each.draws.clear();
    for (const raster::Draw& draw : list.draws)
      for (std::uint32_t t = 0; t < draw.count / 3; ++t)
        each.draws.push_back({draw.first + 3 * t, 3, draw.offset + t, draw.back, {}});
    for (const Face& face : facesAndParts()) {
      const std::vector<ItemId> ids = drawnPlainly(list, face);
      CHECK(ids == drawOne(list, face).ids);
      CHECK(ids == drawnPlainly(each, face));
    }
  }
}

TEST_CASE("PlainRenderer discards fragments of numbered triangles in holes", "[numbers]") {
  reference::Picture picture(16);
  picture.value = PixelValue::TriangleNumbers;
  picture.indexMaps = {{2, 1, {5, raster::holeTexel}}};
  addDraw(picture, 0x100, {}, 0);
  picture.addBlock(picture.whole());
  addDraw(picture, 0x200);
  picture.addBlock(picture.whole(), 2);
  const std::vector<ItemId> ids = drawnPlainly(picture, frontFace(16));
  CHECK(ids == drawOne(picture, frontFace(16)).ids);
  for (std::size_t p = 0; p < ids.size(); ++p) CHECK(ids[p] >> 8 == (p % 16 < 8 ? 1 : 2));
  // Both triangles of a quad meet at its diagonal.
  CHECK(ids[16 * 15] == 0x101);
  CHECK(ids[15] == 0x200);
}

TEST_CASE("PlainRenderer keeps the triangle that each depth test prefers, in every order", "[depth_test]") {
  std::array<float, 4> depths{2, 1, 3, 1};
  std::sort(depths.begin(), depths.end());
  do {
    const auto shown = [&](DepthTest test) {
      DrawList list = plainList();
      list.depthTest = test;
      for (ItemId draw = 0; draw < 4; ++draw) {
        const float w = depths[draw];
        addDraw(list, draw);
        addTriangle(list, {{-w, -w, w}, {3 * w, -w, w}, {-w, 3 * w, w}});
      }
      const std::vector<ItemId> ids = drawnPlainly(list, frontFace(4));
      CHECK(std::count(ids.begin(), ids.end(), ids[0]) == 16);
      return static_cast<std::ptrdiff_t>(ids[0]);
    };
    const auto ascending = std::less<float>();
    CHECK(shown(DepthTest::Nearer) == std::min_element(depths.begin(), depths.end(), ascending) - depths.begin());
    CHECK(shown(DepthTest::NearerOrEqual) == depths.rend() - std::min_element(depths.rbegin(), depths.rend()) - 1);
    CHECK(shown(DepthTest::Farther) == std::max_element(depths.begin(), depths.end(), ascending) - depths.begin());
    for (float& depth : depths) depth = 4 - depth;  // two of them are farthest then
    CHECK(shown(DepthTest::FartherOrEqual) == depths.rend() - std::max_element(depths.rbegin(), depths.rend()) - 1);
    for (float& depth : depths) depth = 4 - depth;
  } while (std::next_permutation(depths.begin(), depths.end()));
}

TEST_CASE("PlainRenderer with the farther test shows what the nearest layers hide", "[depth_test]") {
  // Taking away what is nearest, layer by layer, ends with what is farthest.
  DrawList list = gridTriangles();
  std::vector<std::uint32_t> depthOrder;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    depthOrder.push_back((draw * 7) % 30);
    for (std::size_t k = 0; k < 3; ++k)
      list.positions[list.indices[list.draws[draw].first + k]] *= static_cast<float>(1 + depthOrder.back());
  }
  DrawList farther = list;
  farther.depthTest = DepthTest::Farther;
  const Face face = frontFace(32);
  const std::vector<ItemId> found = drawnPlainly(farther, face);
  std::vector<ItemId> expected(found.size(), 0xFFFFFFFF);
  for (std::uint32_t rank = 0; rank < 30; ++rank) {
    DrawList one = list;
    const auto draw = std::find(depthOrder.begin(), depthOrder.end(), rank) - depthOrder.begin();
    one.draws = {list.draws[static_cast<std::size_t>(draw)]};
    const std::vector<ItemId> ids = drawnPlainly(one, face);
    for (std::size_t p = 0; p < ids.size(); ++p)
      if (ids[p] != 0xFFFFFFFF) expected[p] = ids[p];
  }
  CHECK(found == expected);
  CHECK_THROWS_AS(raster::SoftwareRenderer(farther), raster::InputError);
}

TEST_CASE("PlainRenderer draws a wide viewport like the middle rows of a square with half of y", "[viewport]") {
  const DrawList list = triangleInFront();
  Face wide = frontFace(64), square = frontFace(64);
  wide.viewport = raster::Viewport{64, 32};
  wide.scissor = {0, 0, 64, 32};
  square.y *= 0.5F;
  square.scissor = {0, 16, 64, 32};
  CHECK(drawnPlainly(list, wide) == drawnPlainly(list, square));
  std::swap(wide.viewport->columns, wide.viewport->rows);
  square = frontFace(64);
  square.x *= 0.5F;
  wide.scissor = {0, 0, 32, 64};
  square.scissor = {16, 0, 32, 64};
  CHECK(drawnPlainly(list, wide) == drawnPlainly(list, square));
  CHECK_THROWS_AS(drawOne(list, wide), raster::InputError);
}

TEST_CASE("PlainRenderer draws a viewport of equal sides like a face of that resolution", "[viewport]") {
  Face own = frontFace(64);
  own.viewport = raster::Viewport{64, 64};
  CHECK(drawnPlainly(crossingTriangles(), own) == drawnPlainly(crossingTriangles(), frontFace(64)));
}

TEST_CASE("PlainRenderer samples a corner where a picture of half the resolution has the middle of a pixel",
          "[viewport]") {
  const DrawList list = gridTriangles();
  Face fine = frontFace(32);
  fine.sample = raster::SamplePlace::Corner;
  const std::vector<ItemId> corners = drawnPlainly(list, fine), middles = drawnPlainly(list, frontFace(16));
  std::size_t different = 0;
  for (std::size_t row = 0; row < 16; ++row)
    for (std::size_t column = 0; column < 16; ++column) {
      CHECK(middles[16 * row + column] == corners[32 * (2 * row + 1) + 2 * column + 1]);
      different += middles[16 * row + column] != corners[32 * 2 * row + 2 * column];
    }
  CHECK(different > 16);
}
