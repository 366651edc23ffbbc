// validate of a draw list, at both sides of each limit.
#include "raster/interface/draw_list.h"

#include <catch2/catch.hpp>
#include <functional>

#include "raster/base/input_error.h"
#include "tests/support/validity.h"

using namespace hemitex::raster;

namespace {

/// Two triangles of the same corners: one with the texels 0 to 5 of a map, one without a map.
DrawList list() {
  DrawList list;
  list.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  list.texcoords = {{0, 0}, {1, 0}, {0, 1}};
  list.indices = {0, 1, 2, 0, 2, 1};
  list.indexMaps = {{3, 2, {0, 1, 2, 3, 4, 5}}};
  list.draws = {{0, 3, 16, 254, 0}, {3, 3, 32, {}, {}}};
  list.format = {{4, 4}};
  return list;
}

bool isValid(const std::function<void(DrawList&)>& change) { return hemitex::tests::isValidAfter(change, list()); }

}  // namespace

TEST_CASE("validate accepts a draw list that is made without values", "[draw_list]") {
  CHECK_NOTHROW(validate(DrawList()));
}

TEST_CASE("validate accepts item ID formats of 2 to 32 bits in all", "[draw_list]") {
  const auto isFormat = [](const std::vector<int>& bits) {
    DrawList empty;
    empty.format = {bits};
    return isValid([&](DrawList& l) { l = empty; });
  };
  for (const std::vector<int>& bits : {std::vector{2}, {1, 1}, {32}, {31, 1}, {8, 8, 8, 8}}) CHECK(isFormat(bits));
  for (const std::vector<int>& bits : {std::vector<int>{}, {1}, {33}, {0, 8}, {-1, 8}, {8, 8, 8, 9}, {32, 1}})
    CHECK_FALSE(isFormat(bits));
}

TEST_CASE("validate requires each index to name a vertex, and one texture coordinate per vertex", "[draw_list]") {
  CHECK(isValid([](DrawList&) {}));
  CHECK_FALSE(isValid([](DrawList& l) { l.indices[5] = 3; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.texcoords.pop_back(); }));
  CHECK_FALSE(isValid([](DrawList& l) { l.texcoords.push_back({0, 0}); }));
}

TEST_CASE("validate requires index maps that hold width x height item IDs of the format", "[draw_list]") {
  CHECK(isValid([](DrawList& l) { l.indexMaps[0] = {1, 1, {7}}; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps[0].ids.pop_back(); }));
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps[0].ids.push_back(0); }));
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps[0] = {0, 0, {}}; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps[0] = {0, 3, {}}; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps[0] = {-3, -2, {0, 1, 2, 3, 4, 5}}; }));
  // A map that no draw uses may hold the background.
  CHECK(isValid([](DrawList& l) { l.indexMaps.push_back({1, 1, {255}}); }));
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps.push_back({1, 1, {256}}); }));
}

TEST_CASE("validate requires draws to be runs of whole triangles within the indices", "[draw_list]") {
  CHECK(isValid([](DrawList& l) { l.draws[0].count = 6; }));
  CHECK(isValid([](DrawList& l) { l.draws[1] = {6, 0, 32, {}, {}}; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1].count = 6; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1].count = 2; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1].first = 1; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1].first = 6; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1] = {0xfffffffc, 3, 32, {}, {}}; }));
}

TEST_CASE("validate requires draws to name index maps that exist", "[draw_list]") {
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[0].indexMap = 1; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[0].indexMap = -1; }));
}

TEST_CASE("validate rejects draws that can produce the background or more", "[draw_list]") {
  CHECK(isValid([](DrawList& l) { l.draws[1].offset = 254; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1].offset = 255; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[1].offset = 256; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[0].back = 255; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[0].back = 256; }));
  // 250 has the channels 10 and 15, so that texel 5 gives 15 and 15.
  CHECK(isValid([](DrawList& l) { l.draws[0].offset = 240; }));
  CHECK_FALSE(isValid([](DrawList& l) { l.draws[0].offset = 250; }));
  CHECK(isValid([](DrawList& l) { l.draws[0].offset = 249; }));
}

TEST_CASE("validate rejects draws whose last triangle number is the background", "[draw_list]") {
  const auto isOffset = [](std::size_t draw, ItemId offset) {
    return isValid([&](DrawList& l) {
      l.value = PixelValue::TriangleNumbers;
      l.draws[1].first = 0;
      l.draws[1].count = 6;
      l.draws[draw].offset = offset;
    });
  };
  CHECK(isOffset(0, 254));
  CHECK_FALSE(isOffset(0, 255));
  CHECK(isOffset(1, 253));
  CHECK_FALSE(isOffset(1, 254));
  // Texels give no number, only holes.
  CHECK(isValid([](DrawList& l) { l.value = PixelValue::TriangleNumbers, l.draws[0].offset = 250; }));
}

TEST_CASE("requireUsual refuses other depth tests", "[draw_list]") {
  DrawList l = list();
  CHECK_NOTHROW(requireUsual(l));
  for (const DepthTest test : {DepthTest::NearerOrEqual, DepthTest::Farther, DepthTest::FartherOrEqual}) {
    l.depthTest = test;
    CHECK_NOTHROW(validate(l));
    CHECK_THROWS_AS(requireUsual(l), hemitex::raster::InputError);
  }
}

TEST_CASE("validate accepts holes in index maps of any format and blend", "[draw_list]") {
  for (const Blend blend : {Blend::ClampedAdd, Blend::IntegerAdd, Blend::Replace})
    for (const std::vector<int>& bits : {std::vector{4, 4}, {8, 8, 8, 8}, {32}})
      CHECK(isValid([&](DrawList& l) {
        l.blend = blend;
        l.format = {bits};
        l.indexMaps[0].ids[3] = holeTexel;
      }));
  // Other values wider than the format stay errors.
  CHECK_FALSE(isValid([](DrawList& l) { l.indexMaps[0].ids[3] = holeTexel - 1; }));
  CHECK(hasHoles({2, 1, {0, holeTexel}}));
  CHECK_FALSE(hasHoles({2, 1, {0, holeTexel - 1}}));
}

TEST_CASE("validate rejects draws whose integer sum can be the background", "[draw_list]") {
  const auto isOffset = [](ItemId offset) {
    return isValid([&](DrawList& l) { l.blend = Blend::IntegerAdd, l.draws[0].offset = offset; });
  };
  CHECK(isOffset(249));
  CHECK_FALSE(isOffset(250));  // 250 + 5
  CHECK_FALSE(isOffset(252));
  CHECK(isValid([](DrawList& l) {
    l.blend = Blend::IntegerAdd;
    l.draws[0].offset = 252;
    l.indexMaps[0] = {2, 1, {1, 6}};  // 253, and 258 - 256: neither is 255, though 252 + 7 passes it
  }));
}
