// The inputs of the shaders need no device.
#include "reference/devices/shader_inputs.h"

#include <catch2/catch.hpp>

#include "tests/support/raster_scenes.h"

using namespace hemitex;

TEST_CASE("shaderView marks the highest bit of each channel", "[shaders]") {
  const auto endsOf = [](const std::vector<int>& bits) {
    raster::DrawList list;
    list.format = {bits};
    return reference::shaderView(tests::frontFace(16), list, 8).channelEnds;
  };
  CHECK(endsOf({5, 6, 5}) == (1u << 4 | 1u << 10 | 1u << 15));
  CHECK(endsOf({8, 8, 8, 8}) == 0x80808080u);
  CHECK(endsOf({32}) == 1u << 31);
  CHECK(endsOf({1, 1, 1}) == 7u);
}

TEST_CASE("shaderCorners, shaderDraws and shaderTexels refer to each other", "[shaders]") {
  raster::DrawList list = tests::plainList();
  list.indexMaps = {tests::countingMap(2, 3), tests::countingMap(4, 4)};
  tests::addDraw(list, 100, 7, 1);
  tests::addTriangle(list, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 0}, {1, 0}, {0, 0.5f}});
  tests::addDraw(list, 200, {}, {});
  list.draws[1].cull = raster::Cull::Back;
  tests::addTriangle(list, {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, {{0, 0}, {1, 0}, {0, 1}});

  const auto corners = reference::shaderCorners(list);
  REQUIRE(corners.size() == 6);
  CHECK(corners[1].position == glm::vec3(1, 0, 1));
  CHECK(corners[2].texcoord == glm::vec2(0, 0.5f));
  CHECK(corners[2].draw == 0);
  CHECK(corners[3].draw == 1);

  const auto draws = reference::shaderDraws(list);
  const auto texels = reference::shaderTexels(list);
  REQUIRE(draws.size() == 2);
  CHECK(draws[0].offset == 100);
  CHECK(draws[0].back == 7);
  CHECK(draws[0].hasBack == 1);
  CHECK(draws[0].width == 4);
  CHECK(draws[0].height == 4);
  REQUIRE(texels.size() == 6 + 16);
  CHECK(std::equal(texels.begin() + draws[0].firstTexel, texels.end(), list.indexMaps[1].ids.begin()));
  CHECK(draws[1].hasBack == 0);
  CHECK(draws[1].width == 0);
  CHECK(draws[0].cull == 0);
  CHECK(draws[1].cull == 2);
  CHECK(draws[0].firstTriangle == 0);
  CHECK(draws[1].firstTriangle == 1);
}
