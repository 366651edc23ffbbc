// Times of hemicubes for growing numbers of elements.
#include "reference/measurement/bench/render_times.h"

#include <array>
#include <catch2/catch.hpp>

#include "tests/support/box_scene.h"

using namespace hemitex;

TEST_CASE("growthOf measures each given number of elements along a side", "[bench]") {
  constexpr std::array<int, 3> sides{4, 8, 32};
  const auto points = reference::growthOf(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), sides, 16, 3);
  REQUIRE(points.size() == 3);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    CHECK(points[i].side == sides[i]);
    CHECK(points[i].elements == static_cast<std::size_t>(6 * sides[i] * sides[i]));
    CHECK(points[i].draw.repetitions.size() == 3);
    CHECK(points[i].row.repetitions.size() == 3);
  }
}
