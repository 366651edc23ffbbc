// Version 2 of the rules: positions in clip space, stored depths, windings, and values of pixels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "raster/base/input_error.h"
#include "raster/plain/plain_renderer.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;
using raster::ClipDepth;
using raster::DepthPrecision;
using raster::DepthTest;
using raster::DrawList;
using raster::Face;
using raster::ItemId;
using raster::PixelValue;
using Ids = std::vector<ItemId>;

namespace {

Ids plainIds(const DrawList& list, const Face& face) {
  return render(raster::PlainRenderer(list), {&face, 1}).front().ids;
}

/// Triangles from w = 1 to 4, with coordinates that are multiples of 1/64, each a draw with a back.
DrawList triangles(std::uint32_t seed) {
  std::mt19937 random(seed);
  DrawList list = plainList();
  list.indexMaps.push_back(countingMap(5, 3));
  const auto step = [&](int low, int high) {
    return static_cast<float>(low * 64 + static_cast<int>(random() % static_cast<unsigned>((high - low) * 64))) / 64;
  };
  for (ItemId draw = 1; draw < 30; ++draw) {
    addDraw(list, draw << 8, 0xff00 + draw, 0);
    const auto point = [&] {
      const float x = step(-3, 3), y = step(-3, 3);
      return glm::vec3(x, y, step(1, 4));
    };
    const glm::vec3 a = point(), b = point(), c = point();
    addTriangle(list, {a, b, c}, {{0, 0}, {1, 0.3F}, {0.4F, 1}});
  }
  return list;
}

/// A scene in the view of frontFace in clip space, with z = slope w + constant.
DrawList inClipSpace(DrawList list, ClipDepth range, float slope, float constant) {
  list.clipDepth = range;
  for (const glm::vec3& position : list.positions) list.clipZ.push_back(slope * position.z + constant);
  return list;
}

/// A quad over a pixel at depth z, w = 1, as a draw of its own.
void addQuadAt(DrawList& list, ItemId id, float z) {
  addDraw(list, id);
  addTriangle(list, {{-3, -3, 1}, {-3, 9, 1}, {9, -3, 1}});
  list.clipZ.insert(list.clipZ.end(), 3, z);
}

DrawList emptyClipList() {
  DrawList list = plainList();
  list.clipDepth = ClipDepth::ZeroToOne;
  return list;
}

}  // namespace

TEST_CASE("PlainRenderer draws a scene in clip space as in its view, for each range and direction of z", "[clip]") {
  const Face face = frontFace(32);
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const DrawList scene = triangles(seed);
    const Ids expected = plainIds(scene, face);
    // 1 - n/w with n = 1/2, and its reversal n/w.
    CHECK(plainIds(inClipSpace(scene, ClipDepth::ZeroToOne, 1, -0.5F), face) == expected);
    CHECK(plainIds(inClipSpace(scene, ClipDepth::MinusOneToOne, 1, -1), face) == expected);
    for (const ClipDepth range : {ClipDepth::ZeroToOne, ClipDepth::MinusOneToOne}) {
      DrawList reversed = inClipSpace(scene, range, range == ClipDepth::ZeroToOne ? 0 : -1, 0.5F);
      reversed.depthTest = DepthTest::Farther;
      CHECK(plainIds(reversed, face) == expected);
    }
    DrawList farther = scene;
    farther.depthTest = DepthTest::FartherOrEqual;
    DrawList fartherInClipSpace = inClipSpace(farther, ClipDepth::ZeroToOne, 1, -0.5F);
    CHECK(plainIds(fartherInClipSpace, face) == plainIds(farther, face));
  }
}

TEST_CASE("PlainRenderer with an orthographic projection shows the smallest z", "[clip]") {
  std::mt19937 random(4);
  for (int k = 0; k < 200; ++k) {
    DrawList list = emptyClipList();
    Ids visible;
    float nearest = 2;
    for (ItemId id = 0; id < 6; ++id) {
      const float z = uniform(random, -0.5F, 1.5F);
      addQuadAt(list, id, z);
      if (z < 0 || z > 1 || z >= nearest) continue;
      nearest = z;
      visible = {id};
    }
    CHECK(plainIds(list, frontFace(2))[0] == (visible.empty() ? 0xffffffff : visible[0]));
  }
}

TEST_CASE("PlainRenderer cuts a ramp in z at both planes of each range", "[clip]") {
  // Along a row of 64 pixels z runs from -2 to 2, so that each pixel spans 1/16.
  for (const ClipDepth range : {ClipDepth::ZeroToOne, ClipDepth::MinusOneToOne}) {
    DrawList list = plainList();
    list.clipDepth = range;
    addDraw(list, 7);
    reference::addQuad(list, {glm::vec3(-1, -1, 1), {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});
    for (const glm::vec3& position : list.positions) list.clipZ.push_back(2 * position.x);
    const Ids ids = plainIds(list, frontFace(64));
    for (std::size_t column = 0; column < 64; ++column) {
      const bool isInside = column >= (range == ClipDepth::ZeroToOne ? 32U : 16U) && column < 48;
      CHECK((ids[64 * 5 + column] == 7) == isInside);
    }
  }
}

TEST_CASE("PlainRenderer draws no point with w <= 0, and what is before the eye of triangles through it", "[clip]") {
  for (const float w : {0.0F, -1.0F, -4.0F}) {
    DrawList list = emptyClipList();
    addDraw(list, 1);
    for (const float z : {0.0F, -0.5F, 0.5F}) {
      addTriangle(list, {{-3, -3, w}, {-3, 9, w}, {9, -3, w}});
      list.clipZ.insert(list.clipZ.end(), 3, z);
    }
    const Ids ids = plainIds(list, frontFace(8, 0x1p-20F));
    CHECK(std::count(ids.begin(), ids.end(), 0xffffffff) == 64);
  }
  // y = w - 1 along an edge from (0, 0, 1) towards w = -1: of the column x = 0 it shows rows with y/w from -inf to 0.
  DrawList list = emptyClipList();
  addDraw(list, 1);
  addTriangle(list, {{-8, 0, 1}, {8, 0, 1}, {0, -2, -1}});
  list.clipZ = {0.5F, 0.5F, -0.5F};
  const Ids ids = plainIds(list, frontFace(8, 0x1p-20F));
  for (std::size_t row = 0; row < 8; ++row) CHECK((ids[8 * row + 4] == 1) == (row < 4));
}

TEST_CASE("PlainRenderer stores depths rounded to nearest, ties to even", "[clip]") {
  // z in binary32 times 2^bits - 1 is exact in double precision.
  std::mt19937 random(8);
  for (const DepthPrecision precision : {DepthPrecision::Unorm16, DepthPrecision::Unorm24, DepthPrecision::Float32})
    for (int k = 0; k < 400; ++k) {
      const double steps = precision == DepthPrecision::Unorm16 ? 65535 : 16777215;
      const float first = uniform(random, 0, 1);
      const float second = first - static_cast<float>((static_cast<double>(random() % 5) - 2) / (2 * steps));
      if (second < 0 || second > 1) continue;
      DrawList list = emptyClipList();
      list.depthPrecision = precision;
      addQuadAt(list, 1, first);
      addQuadAt(list, 2, second);
      const auto stored = [&](float z) {
        const auto depth = static_cast<double>(z);
        return precision == DepthPrecision::Float32 ? depth : std::nearbyint(depth * steps);
      };
      CHECK(plainIds(list, frontFace(2))[0] == (stored(second) < stored(first) ? 2 : 1));
    }
}

TEST_CASE("PlainRenderer rounds depths exactly between two stored ones to the even one", "[clip]") {
  // z/w with w = 65535 is exactly between two stored depths where z is half a number.
  const auto shown = [](int quarter, int against) {
    DrawList list = plainList();
    list.clipDepth = ClipDepth::ZeroToOne;
    list.depthPrecision = DepthPrecision::Unorm16;
    const auto add = [&](ItemId id, float z) {
      addDraw(list, id);
      addTriangle(list, {{-3 * 65535.0F, -3 * 65535.0F, 65535},
                         {-3 * 65535.0F, 9 * 65535.0F, 65535},
                         {9 * 65535.0F, -3 * 65535.0F, 65535}});
      list.clipZ.insert(list.clipZ.end(), 3, z);
    };
    add(1, static_cast<float>(against));
    add(2, static_cast<float>(quarter) / 4);
    return plainIds(list, frontFace(2))[0];
  };
  CHECK(shown(4 * 100 + 2, 101) == 2);  // 100.5 is stored as 100, before 101
  CHECK(shown(4 * 100 + 3, 101) == 1);
  CHECK(shown(4 * 101 + 2, 102) == 1);  // 101.5 is stored as 102
  CHECK(shown(4 * 101 + 1, 102) == 2);
}

TEST_CASE("PlainRenderer keeps facing where rows count upwards, and turns it with the winding of fronts", "[clip]") {
  DrawList list = triangles(3);
  for (raster::Draw& draw : list.draws) draw.cull = raster::Cull::Back;
  list = inClipSpace(list, ClipDepth::ZeroToOne, 1, -0.5F);
  const Face face = frontFace(32);
  Face upwards = face;
  upwards.y = -face.y;
  // Turned over, rows move; samples on edges may change their triangle.
  const Ids down = plainIds(list, face), up = plainIds(list, upwards);
  int differing = 0;
  for (std::size_t row = 0; row < 32; ++row)
    for (std::size_t column = 0; column < 32; ++column)
      differing += down[32 * row + column] != up[32 * (31 - row) + column];
  CHECK(differing < 30);
  DrawList turned = list;
  turned.front = raster::Winding::Clockwise;
  for (raster::Draw& draw : turned.draws) draw.cull = raster::Cull::Front;
  for (raster::Draw& draw : turned.draws) draw.back.reset();
  for (raster::Draw& draw : list.draws) draw.back.reset();
  CHECK(plainIds(turned, face) == plainIds(list, face));
}

TEST_CASE("PlainRenderer gives triangles the value of their first or last vertex", "[values]") {
  DrawList list = triangles(5);
  list.value = PixelValue::VertexValues;
  for (raster::Draw& draw : list.draws) draw.back.reset();
  std::mt19937 random(1);
  for (std::size_t v = 0; v < list.positions.size(); ++v)
    list.vertexValues.push_back(static_cast<ItemId>(random() % 1000));
  for (const std::size_t corner : {0U, 2U}) {
    list.provoking = corner == 0 ? raster::Provoking::First : raster::Provoking::Last;
    DrawList each = list;  // draws with the value as their offset
    each.value = PixelValue::ItemIds;
    each.vertexValues.clear();
    for (raster::Draw& draw : each.draws) {
      draw.offset += list.vertexValues[list.indices[draw.first + corner]];
      draw.indexMap.reset();
    }
    CHECK(plainIds(list, frontFace(32)) == plainIds(each, frontFace(32)));
  }
}

TEST_CASE("PlainRenderer counts the fragments that pass: the changes of pixels as draws are added", "[values]") {
  for (const DepthTest test : {DepthTest::Nearer, DepthTest::FartherOrEqual}) {
    DrawList list = triangles(6);
    list.depthTest = test;
    for (raster::Draw& draw : list.draws) draw.indexMap.reset();
    const Face face = frontFace(32);
    Ids counts(32 * 32), before(32 * 32, 0xffffffff);
    for (std::size_t draws = 1; draws <= list.draws.size(); ++draws) {
      DrawList part = list;
      part.draws.resize(draws);
      const Ids now = plainIds(part, face);
      for (std::size_t p = 0; p < now.size(); ++p) counts[p] += now[p] != before[p];
      before = now;
    }
    list.value = PixelValue::PassedSamples;
    CHECK(plainIds(list, face) == counts);
  }
}

TEST_CASE("validate refuses clip space without z, and z without clip space", "[draw_list]") {
  DrawList list = triangles(1);
  CHECK_NOTHROW(validate(list));
  list.clipDepth = ClipDepth::ZeroToOne;
  CHECK_THROWS_AS(validate(list), raster::InputError);
  list.clipZ.resize(list.positions.size());
  CHECK_NOTHROW(validate(list));
  CHECK_FALSE(isUsual(list));
  list.clipDepth = ClipDepth::None;
  CHECK_THROWS_AS(validate(list), raster::InputError);
}
