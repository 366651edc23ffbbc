// The kinds of wrong item IDs.
#include "reference/conformance/verdict/error_pixel.h"

#include <catch2/catch.hpp>

#include "raster/plain/plain_renderer.h"
#include "tests/support/judged_wall.h"

using namespace hemitex;
using reference::ErrorKind;
using tests::JudgedWall;

TEST_CASE("errorAt classifies what the device shows in place of the expected item ID", "[verdict]") {
  JudgedWall wall;
  raster::DrawList& list = wall.vector.list;
  tests::addDraw(list, 0x200);
  tests::addPixel(list, 8, 7, 7, 0.5);                            // before the wall
  for (glm::vec3& position : list.positions) position.x -= 0.5f;  // the wall covers columns 0 to 5
  const auto kindAt = [&](int column, int row, raster::ItemId found) {
    return errorAt(list, wall.vector.faces[0], column, row, found).kind;
  };
  CHECK(kindAt(1, 1, 0xffffff) == ErrorKind::Missing);
  CHECK(kindAt(7, 1, 0x101) == ErrorKind::Extra);
  CHECK(kindAt(1, 1, 0x200) == ErrorKind::WrongSurface);
  CHECK(kindAt(1, 1, 0x10f) == ErrorKind::WrongElement);
  CHECK(kindAt(1, 1, 0x300) == ErrorKind::WrongSide);
  CHECK(kindAt(1, 1, 0x110) == ErrorKind::ForeignId);
  CHECK(kindAt(7, 1, 0x110) == ErrorKind::ForeignId);
}

TEST_CASE("errorAt reports the expected item ID that it is given", "[verdict]") {
  const JudgedWall wall;
  const auto triangles = raster::snappedTriangles(wall.vector.list, wall.vector.faces[0].face);
  const reference::ErrorPixel error = reference::errorAt(wall.vector.list, "top", triangles, 1, 1, 0x105, 0x10f);
  CHECK(error.expected == 0x105);
  CHECK(toText(error.expectedOrigin) == "draw 0 texel 1,1");
  CHECK(error.found == 0x10f);
}

TEST_CASE("errorAt prefers the visible draw where several draws give an item ID", "[verdict]") {
  // Draw 1 gives the item IDs of draw 0, and lies before it.
  JudgedWall wall;
  raster::DrawList& list = wall.vector.list;
  tests::addDraw(list, 0x100, {}, 0);
  tests::addTriangle(list, {{-0.5, -0.5, 0.5}, {0.5, -0.5, 0.5}, {-0.5, 0.5, 0.5}}, {{0, 0}, {1, 0}, {0, 1}});
  const reference::ErrorPixel error = errorAt(list, wall.vector.faces[0], 1, 1, 0x10f);
  REQUIRE(error.visible);
  CHECK(error.visible->draw == 1);
  CHECK(error.expectedOrigin.draw == 1);
  CHECK(error.foundOrigin.draw == 1);
  CHECK(error.kind == ErrorKind::WrongElement);
}
