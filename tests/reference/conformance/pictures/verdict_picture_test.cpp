// A verdict as a picture.
#include "reference/conformance/pictures/verdict_picture.h"

#include <catch2/catch.hpp>

#include "tests/support/judged_wall.h"

using namespace hemitex;
using tests::JudgedWall;

TEST_CASE("toPicture shows expected, found and verdict side by side, one row per face", "[verdict]") {
  JudgedWall judged;
  judged.found[0].ids[0] = 0xffffff;
  const radiosity::Image picture = toPicture(judged.verdict(), 0xffffff);
  constexpr int gap = 4;
  REQUIRE(picture.width == 3 * 8 + 2 * gap);
  REQUIRE(picture.height == 8 + gap + 4);
  const auto at = [&](int column, int row) {
    return picture.pixels[static_cast<std::size_t>(row * picture.width + column)];
  };
  CHECK(at(0, 0) != glm::dvec3(0.0));
  CHECK(at(12, 0) == glm::dvec3(0.0));      // the background is black
  CHECK(at(24, 0) == glm::dvec3(1, 0, 0));  // an error is red
  CHECK(at(1, 0) == at(13, 0));             // equal item IDs have equal colours
  CHECK(at(0, 12) != at(2, 12));            // different item IDs have others
  CHECK(at(25, 0).x == at(25, 0).y);        // exact is grey
}
