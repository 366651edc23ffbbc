// The inputs of the shaders need no device.
#include "reference/devices/shader_inputs.h"

#include <catch2/catch.hpp>

#include "tests/support/raster_scenes.h"

using namespace hemitex;

TEST_CASE("shaderView marks the highest bit of each channel", "[shaders]") {
  const auto endsOf = [](const std::vector<int>& bits) {
    raster::DrawList list;
    list.format = {bits};
    return reference::shaderView(tests::frontFace(16), list, {-56, -56, 128, 128}).channelEnds;
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
}

TEST_CASE("shaderCorners have the value of their triangle, and z in clip space or -1", "[shaders]") {
  raster::DrawList list = tests::plainList();
  for (const raster::ItemId offset : {100U, 200U}) {
    tests::addDraw(list, offset);
    for (int k = 0; k < 2; ++k) tests::addTriangle(list, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  }
  const auto numbersOf = [&] {
    std::vector<raster::ItemId> numbers;
    const auto corners = reference::shaderCorners(list);
    for (std::size_t c = 0; c < corners.size(); c += 3) numbers.push_back(corners[c].number);
    return numbers;
  };
  list.value = raster::PixelValue::TriangleNumbers;
  CHECK(numbersOf() == std::vector<raster::ItemId>{100, 101, 200, 201});
  list.value = raster::PixelValue::VertexValues;
  for (raster::ItemId v = 0; v < 12; ++v) list.vertexValues.push_back(v);
  CHECK(numbersOf() == std::vector<raster::ItemId>{100, 103, 206, 209});
  list.provoking = raster::Provoking::Last;
  CHECK(numbersOf() == std::vector<raster::ItemId>{102, 105, 208, 211});

  CHECK(reference::shaderCorners(list)[3].z == -1);
  CHECK(reference::shaderTriangles(list) == 2);
  list.clipDepth = raster::ClipDepth::ZeroToOne;
  for (int v = 0; v < 12; ++v) list.clipZ.push_back(static_cast<float>(v) / 16);
  CHECK(reference::shaderCorners(list)[3].z == 0.1875F);
  CHECK(reference::shaderTriangles(list) == 4);
}

TEST_CASE("shaderView has the depths of a list: w, 1 - n/w, z/w or (z/w + 1)/2", "[shaders]") {
  raster::DrawList list = tests::plainList();
  const raster::Face face = tests::frontFace(16, 0.25F);
  const auto depthOf = [&] {
    const reference::ShaderView view = reference::shaderView(face, list, {0, 0, 16, 16});
    return glm::vec2(view.depthScale, view.depthOffset);
  };
  CHECK(depthOf().x == 0);
  list.depthPrecision = raster::DepthPrecision::Unorm16;
  CHECK(depthOf() == glm::vec2(0.25F, 1));
  list.clipDepth = raster::ClipDepth::ZeroToOne;
  CHECK(depthOf() == glm::vec2(1, 0));
  list.clipDepth = raster::ClipDepth::MinusOneToOne;
  CHECK(depthOf() == glm::vec2(0.5F, 0.5F));
}
