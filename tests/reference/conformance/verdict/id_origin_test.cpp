// Which draw and texel an item ID comes from.
#include <catch2/catch.hpp>

#include "reference/conformance/verdict/error_pixel.h"
#include "tests/support/judged_wall.h"

using namespace hemitex;
using reference::originOf;
using reference::toText;
using tests::JudgedWall;

TEST_CASE("originOf finds the draw and texel of an item ID", "[verdict]") {
  raster::DrawList list = JudgedWall().vector.list;
  tests::addDraw(list, 0x200);
  tests::addDraw(list, 0xff00fe, {}, 0);  // clamps with texels above 1
  CHECK(toText(originOf(list, 0xffffff)) == "background");
  CHECK(toText(originOf(list, 0x100)) == "draw 0 texel 0,0");
  CHECK(toText(originOf(list, 0x10d)) == "draw 0 texel 1,3");
  CHECK(toText(originOf(list, 0x110)) == "no draw");
  CHECK(toText(originOf(list, 0x200)) == "draw 1");
  CHECK(toText(originOf(list, 0x300)) == "back of draw 0");
  CHECK(toText(originOf(list, 0xff00ff)) == "draw 2 texel 1,0");
  CHECK(toText(originOf(list, 0xff0100)) == "no draw");  // a carry that clamped addition cannot make
}

TEST_CASE("originOf finds the draw and the triangle of a triangle number", "[verdict]") {
  raster::DrawList list = JudgedWall().vector.list;
  list.value = raster::PixelValue::TriangleNumbers;
  tests::addDraw(list, 0x200);
  tests::addTriangle(list, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  CHECK(toText(originOf(list, 0x100)) == "draw 0 triangle 0");
  CHECK(toText(originOf(list, 0x101)) == "draw 0 triangle 1");
  CHECK(toText(originOf(list, 0x102)) == "no draw");
  CHECK(toText(originOf(list, 0xff)) == "no draw");
  CHECK(toText(originOf(list, 0x200)) == "draw 1 triangle 2");
  CHECK(toText(originOf(list, 0x300)) == "back of draw 0");
}
