// sheetsLitFromBothSides: what has two sides in a lit room, and what has not.
#include "radiosity/scene/open_sheets.h"

#include <catch2/catch.hpp>

#include "tests/support/box_text.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::BoxText;

namespace {

/// A closed room with a lamp under its ceiling.
BoxText room() {
  BoxText objects;
  objects.begin("room");
  objects.addBox({0, 0, 0}, {4, 3, 4}, true);
  objects.begin("lamp", "lamp");
  objects.addQuad({{{1, 2.9, 1}, {3, 2.9, 1}, {3, 2.9, 3}, {1, 2.9, 3}}});
  return objects;
}

std::vector<std::string> sheetsOf(const BoxText& objects) {
  const Scene scene = objects.load({.sides = Sides::One});
  std::vector<std::string> names;
  for (const std::uint32_t s : sheetsLitFromBothSides(scene)) names.push_back(scene.surfaces[s].name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("sheetsLitFromBothSides finds no sheet in closed rooms and solids, nor an emitter", "[sheets]") {
  BoxText objects = room();
  objects.begin("solid");
  objects.addBox({1, 0.5, 1}, {2, 1, 2}, false);
  CHECK(sheetsOf(objects).empty());
}

TEST_CASE("sheetsLitFromBothSides finds a curtain, a table top and a wall of one face between two parts of a room",
          "[sheets]") {
  BoxText objects = room();
  objects.begin("curtain");
  objects.addQuad({{{0.5, 0.2, 0.5}, {2, 0.2, 0.5}, {2, 2, 0.5}, {0.5, 2, 0.5}}});
  objects.begin("table");
  objects.addQuad({{{1, 0.8, 3}, {2, 0.8, 3}, {2, 0.8, 2}, {1, 0.8, 2}}});
  objects.begin("wall");
  objects.addQuad({{{2.5, 0, 0}, {2.5, 0, 4}, {2.5, 3, 4}, {2.5, 3, 0}}});
  objects.begin("other-lamp", "lamp");
  objects.addQuad({{{3, 2.9, 1}, {3.9, 2.9, 1}, {3.9, 2.9, 3}, {3, 2.9, 3}}});
  CHECK(sheetsOf(objects) == Names{"curtain", "table", "wall"});
}

TEST_CASE("sheetsLitFromBothSides leaves out a box without a bottom, a rug, and what lies outside", "[sheets]") {
  BoxText objects = room();
  objects.begin("box");
  objects.addBox({1, 0, 1}, {2, 1, 2}, false, 5);
  objects.begin("rug");
  objects.addQuad({{{2.5, 0.002, 3.5}, {3.5, 0.002, 3.5}, {3.5, 0.002, 2.5}, {2.5, 0.002, 2.5}}});
  objects.begin("ground");
  objects.addQuad({{{-9, -0.1, 9}, {9, -0.1, 9}, {9, -0.1, -9}, {-9, -0.1, -9}}});
  objects.begin("outer-wall");
  objects.addQuad({{{-1, 0, 4}, {-1, 0, 0}, {-1, 3, 0}, {-1, 3, 4}}});
  CHECK(sheetsOf(objects).empty());
}

TEST_CASE("loadScene gives sheets a twin, and no other surface", "[sheets]") {
  BoxText objects = room();
  objects.begin("curtain");
  objects.addQuad({{{0.5, 0.2, 0.5}, {2, 0.2, 0.5}, {2, 2, 0.5}, {0.5, 2, 0.5}}});
  const Scene scene = objects.load({.sides = Sides::TwoOfSheets});
  REQUIRE(scene.surfaces.size() == 9);
  CHECK(scene.surfaces.back().name == "curtain/back");
  CHECK(scene.surfaces[7].twin == 8);
  CHECK(scene.surfaces[8].twin == 7);
  for (std::size_t s = 0; s < 7; ++s) CHECK_FALSE(scene.surfaces[s].twin);
}
