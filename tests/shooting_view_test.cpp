// Where a projection stands: what it leaves out, and how near it looks.
#include "radiosity/shooting_view.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

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

TEST_CASE("the nearest triangle is the same whether boxes are looked into first or not", "[view]") {
  // Single triangles, a scene each, say how far each of them is.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return glm::dvec3(coordinate(random), coordinate(random), coordinate(random)); };
  Scene scene;
  scene.extent = 3;
  scene.surfaces.resize(3);
  for (int t = 0; t < 150; ++t) {
    const glm::dvec3 middle = point();
    Triangle triangle;
    for (glm::dvec3& corner : triangle.position) corner = middle + 0.1 * point();
    scene.surfaces[static_cast<std::size_t>(t % 2)].triangles.push_back(triangle);
  }
  const std::vector<std::uint32_t> skipped{0, 31, 32, 33, 74, 75, 149};
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 eye = point();
    double nearest = scene.extent;
    std::uint32_t number = 0;
    for (const Surface& surface : scene.surfaces)
      for (const Triangle& triangle : surface.triangles) {
        Scene lone;
        lone.extent = scene.extent;
        lone.surfaces.resize(1);
        lone.surfaces[0].triangles = {triangle};
        if (std::find(skipped.begin(), skipped.end(), number++) == skipped.end())
          nearest = std::min(nearest, nearDistance(lone, eye, {}, hemicubeSquaredReach));
      }
    CHECK(nearDistance(scene, eye, skipped, hemicubeSquaredReach) == nearest);
  }
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
