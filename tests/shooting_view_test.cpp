// Where a projection stands: what it leaves out, and how near it looks.
#include "radiosity/shooting_view.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/hemicube.h"
#include "tests/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("the near distance of a hemicube is the distance to the nearest triangle over the square root of three",
          "[view]") {
  const Scene cube = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const double root3 = std::sqrt(3.0);
  // On the floor (triangles 4 and 5 are left out), 0.2 from the left wall.
  CHECK(nearDistance(cube, {0.2, 0, 0.6}, {4, 5}, hemicubeSquaredReach) == Approx(0.2 / root3).epsilon(1e-12));
  // Nothing left out: the point lies on the floor itself.
  CHECK(nearDistance(cube, {0.2, 0, 0.6}, {}, hemicubeSquaredReach) == smallestNearDistance * cube.extent);
  // Nearest to an edge and to a corner of a lone square in the plane y = 0, from outside of it.
  Scene lone;
  lone.surfaces = {tests::quad("lone", {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}})};
  lone.extent = 10;
  CHECK(nearDistance(lone, {0.5, 0.3, -0.4}, {}, hemicubeSquaredReach) == Approx(0.5 / root3).epsilon(1e-12));
  CHECK(nearDistance(lone, {-1, 2, 3}, {}, hemicubeSquaredReach) ==
        Approx(3 / root3).epsilon(1e-12));  // 1, 2, 2 from the corner (0, 0, 1)
  CHECK(nearDistance(lone, {0.5, 0.3, -0.4}, {0, 1}, hemicubeSquaredReach) == lone.extent);
}

TEST_CASE("a view leaves out its own surface's triangles in the tangent plane, and no others", "[view]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  // A second piece of floor beside the first, coplanar but another surface, and a bent quad.
  scene.surfaces.push_back(tests::quad("beside", {{{1, 0, 0}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}}}));
  scene.surfaces.push_back(tests::quad("bent", {{{0, 3, 0}, {1, 3, 0}, {1, 3.5, 1}, {0, 3, 1}}}));
  scene = tests::finish(scene);
  CHECK(skippedTriangles(scene, 2, {{0.3, 0, 0.3}, {0, 1, 0}, 0}) == std::vector<std::uint32_t>{4, 5});
  const glm::dvec3 bent = normal(scene.surfaces[7].triangles[0]);
  CHECK(skippedTriangles(scene, 7, {{0.6, 3, 0}, bent, 0}) == std::vector<std::uint32_t>{14});
}
