// The view of a projection: its skipped triangles and its near distance.
#include "radiosity/projection/patch_view.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/geometry/tangent_along.h"
#include "radiosity/projection/projection.h"
#include "radiosity/projection/projection_kinds.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("nearDistance of a hemicube is the distance to the nearest triangle over the square root of three",
          "[view]") {
  const Scene cube = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const double root3 = std::sqrt(3.0);
  // On the floor (triangles 4 and 5 are skipped), 0.2 from the left wall.
  CHECK(nearDistance(cube, triangleBoxes(cube), {0.2, 0, 0.6}, {4, 5}, hemicubeSquaredReach) ==
        Approx(0.2 / root3).epsilon(1e-12));
  // Without skipped triangles, the point lies on the floor itself.
  CHECK(nearDistance(cube, triangleBoxes(cube), {0.2, 0, 0.6}, {}, hemicubeSquaredReach) ==
        smallestNearDistance * cube.extent);
  // Nearest to an edge and to a corner of a single square in the plane y = 0, from outside of it.
  Scene lone;
  lone.surfaces = {tests::quad("lone", {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}})};
  lone.extent = 10;
  CHECK(nearDistance(lone, triangleBoxes(lone), {0.5, 0.3, -0.4}, {}, hemicubeSquaredReach) ==
        Approx(0.5 / root3).epsilon(1e-12));
  CHECK(nearDistance(lone, triangleBoxes(lone), {-1, 2, 3}, {}, hemicubeSquaredReach) ==
        Approx(3 / root3).epsilon(1e-12));  // 1, 2, 2 from the corner (0, 0, 1)
  CHECK(nearDistance(lone, triangleBoxes(lone), {0.5, 0.3, -0.4}, {0, 1}, hemicubeSquaredReach) == lone.extent);
}

TEST_CASE("nearDistance is the same with and without boxes", "[view]") {
  // Single triangles, each as a scene of its own, give the distance of each of them.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return glm::dvec3{coordinate(random), coordinate(random), coordinate(random)}; };
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
          nearest = std::min(nearest, nearDistance(lone, triangleBoxes(lone), eye, {}, hemicubeSquaredReach));
      }
    CHECK(nearDistance(scene, triangleBoxes(scene), eye, skipped, hemicubeSquaredReach) == nearest);
  }
}

TEST_CASE("skippedTriangles are those of the own surface in the tangent plane, and no others", "[view]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  // A second piece of floor beside the first, coplanar but another surface, and a bent quad.
  scene.surfaces.push_back(tests::quad("beside", {{{1, 0, 0}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}}}));
  scene.surfaces.push_back(tests::quad("bent", {{{0, 3, 0}, {1, 3, 0}, {1, 3.5, 1}, {0, 3, 1}}}));
  scene = tests::finish(scene);
  CHECK(skippedTriangles(scene, triangleBoxes(scene), 2, {{0.3, 0, 0.3}, {0, 1, 0}, 0}) ==
        std::vector<std::uint32_t>{4, 5});
  const glm::dvec3 bent = normal(scene.surfaces[7].triangles[0]);
  CHECK(skippedTriangles(scene, triangleBoxes(scene), 7, {{0.6, 3, 0}, bent, 0}) == std::vector<std::uint32_t>{14});
}

TEST_CASE("skippedTriangles are the same with and without boxes", "[view]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const glm::dvec3& normal : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::normalize(glm::dvec3(3, -1, 2))}) {
    // Runs of triangles in the tangent plane, next to it on either side of the tolerance, across it and far from it; a
    // surface with a twin, and one without.
    const SurfacePoint point{{0.3, -0.2, 0.7}, normal, 0};
    const glm::dvec3 x = tangentAlong(normal, glm::dvec3(0)), y = glm::cross(normal, x);
    Scene scene;
    scene.extent = 2;
    scene.surfaces.resize(3);
    const double tolerance = tangentPlaneTolerance * scene.extent;
    const double inside = 0.999 * tolerance, outside = 1.001 * tolerance;
    const std::array<std::pair<double, double>, 7> runs{
        {{0, 0}, {-inside, inside}, {0, outside}, {-outside, 0}, {outside, outside}, {-0.1, 0.1}, {-0.1, -0.1}}};
    constexpr std::uint32_t runLength = 64;
    std::vector<std::uint32_t> expected;
    std::uint32_t number = 0;
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
      for (std::size_t t = 0; t < runs.size() * runLength; ++t) {
        const auto& [lowest, highest] = runs.at(t / runLength);
        Triangle triangle;
        bool liesInPlane = true;
        for (glm::dvec3& corner : triangle.position) {
          corner = point.position + coordinate(random) * x + coordinate(random) * y +
                   (coordinate(random) > 0 ? lowest : highest) * normal;
          liesInPlane = liesInPlane && std::abs(glm::dot(corner - point.position, normal)) <= tolerance;
        }
        const auto& [a, b, c] = triangle.position;
        const bool facesAway = glm::dot(point.position - a, glm::cross(b - a, c - a)) < 0;
        if (s < 2 && (liesInPlane || facesAway)) expected.push_back(number);
        ++number;
        scene.surfaces[s].triangles.push_back(triangle);
      }
    makeTwins(scene.surfaces, 0, 1);
    CHECK(skippedTriangles(scene, triangleBoxes(scene), 0, point) == expected);
    // Without twins, only the tangent plane matters.
    for (Surface& surface : scene.surfaces) {
      surface.twin = {};
      for (Triangle& triangle : surface.triangles) triangle.isBacked = false;
    }
    std::erase_if(expected, [&](std::uint32_t t) {
      if (t >= scene.surfaces[0].triangles.size()) return true;
      const auto& position = scene.surfaces[0].triangles[t].position;
      return std::any_of(position.begin(), position.end(), [&](const glm::dvec3& corner) {
        return std::abs(glm::dot(corner - point.position, normal)) > tolerance;
      });
    });
    CHECK(skippedTriangles(scene, triangleBoxes(scene), 0, point) == expected);
    CHECK(!expected.empty());
  }
}
