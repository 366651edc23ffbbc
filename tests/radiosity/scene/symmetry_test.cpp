// setSymmetry: the images of surfaces behind mirror planes and in periodic boxes.
#include "radiosity/scene/symmetry.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "raster/base/input_error.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A triangle that faces +z, in the corner of the planes x = 0 and y = 0.
Scene corner() {
  Scene scene;
  scene.materials.push_back({});
  Surface surface{.name = "a", .family = "a", .triangles = {}};
  surface.triangles.push_back({.position = {glm::dvec3(0, 0, 1), {2, 0, 1}, {0, 1, 1}}, .chart = {}, .texcoord = {}});
  scene.surfaces.push_back(surface);
  measureBounds(scene);
  return scene;
}

std::vector<Triangle> placedTriangles(const Scene& scene) {
  std::vector<Triangle> triangles;
  forEachPlace(scene, [&](const TrianglePlace& place) { triangles.push_back(placed(scene, place)); });
  return triangles;
}

}  // namespace

TEST_CASE("setSymmetry reflects surfaces at mirror planes, with their fronts", "[symmetry]") {
  Scene scene = corner();
  setSymmetry(scene, {.mirrors = {std::vector{0.0}, std::vector{0.0}, std::vector{3.0}}});
  REQUIRE(scene.surfaces.size() == 1);
  const std::vector<Triangle> triangles = placedTriangles(scene);
  REQUIRE(triangles.size() == 8);
  CHECK(placedTriangleCount(scene) == 8);
  CHECK(triangles[0].position == scene.surfaces[0].triangles[0].position);
  glm::dvec3 sum(0);
  for (const Triangle& triangle : triangles) {
    CHECK(area(triangle) == 1);
    // A plane across z turns the normal; those across x and y keep it.
    const double z = middleOf(triangle).z;
    CHECK((z == 1 || z == 5));
    CHECK(normal(triangle) == glm::dvec3(0, 0, z == 1 ? 1 : -1));
    sum += middleOf(triangle);
  }
  CHECK(sum == glm::dvec3(0, 0, 8 * 3));  // the middle is where the planes meet
  CHECK(scene.origin == glm::dvec3(0, 0, 3));
}

TEST_CASE("setSymmetry repeats a box on both sides, and what is between two mirrors with twice their distance",
          "[symmetry]") {
  Scene scene = corner();
  setSymmetry(scene, {.period = {2, 3, 0}, .repeats = 2});
  REQUIRE(placedTriangleCount(scene) == 25);
  double lowest = 0, highest = 0;
  for (const Triangle& triangle : placedTriangles(scene)) {
    CHECK(normal(triangle) == glm::dvec3(0, 0, 1));
    lowest = std::min(lowest, triangle.position[0].y);
    highest = std::max(highest, triangle.position[0].y);
  }
  CHECK(lowest == -6);
  CHECK(highest == 6);

  Scene channel = corner();
  setSymmetry(channel,
              {.mirrors = {std::vector{2.0, 0.0}, std::vector<double>(), std::vector<double>()}, .repeats = 1});
  REQUIRE(placedTriangleCount(channel) == 6);
  // The corner at x = 0 is at -4, 0 and 4, each time with both of its sides; it is the first, or, turned over, the
  // last.
  std::vector<double> corners;
  for (const Triangle& triangle : placedTriangles(channel))
    for (const glm::dvec3& position : triangle.position)
      if (position.y == 1) corners.push_back(position.x);
  std::sort(corners.begin(), corners.end());
  CHECK(corners == std::vector<double>{-4, -4, 0, 0, 4, 4});
}

TEST_CASE("setSymmetry refuses planes that cut a surface, and axes with two kinds of symmetry", "[symmetry]") {
  Scene scene = corner();
  const auto refuses = [&](const Symmetry& symmetry, const std::string& part) {
    CHECK_THROWS_WITH(setSymmetry(scene, symmetry), Catch::Matchers::Contains(part));
  };
  refuses({.mirrors = {std::vector{0.5}, std::vector<double>(), std::vector<double>()}},
          "x = 0.5 cuts the surface `a`");
  refuses({.mirrors = {std::vector{0.0}, std::vector<double>(), std::vector<double>()}, .period = {2, 0, 0}},
          "mirror planes and a period along x");
  refuses({.mirrors = {std::vector{0.0, 0.0}, std::vector<double>(), std::vector<double>()}}, "two different mirror");
  refuses({.period = {0, -1, 0}}, "period along y is -1");
  refuses({.period = {1, 1, 1}, .repeats = 1000}, "triangles");
  CHECK(scene.instances.size() == 1);
}

TEST_CASE("setSymmetry refuses repeats of nothing, and images whose positions binary32 cannot tell apart",
          "[symmetry]") {
  const auto messageOf = [](const Symmetry& symmetry) -> std::string {
    Scene scene = corner();
    try {
      setSymmetry(scene, symmetry);
    } catch (const raster::InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(messageOf({.repeats = 2}).find("nothing is repeated") != std::string::npos);
  CHECK(messageOf({.mirrors = {std::vector{0.0}, {}, {}}, .repeats = 2}).find("nothing is repeated") !=
        std::string::npos);
  CHECK(messageOf({.period = {1e300, 0, 0}}).find("along x is farther away") != std::string::npos);
  CHECK(messageOf({.mirrors = {std::vector<double>{}, std::vector<double>{}, std::vector{-1e7, 1e7}}})
            .find("along z is farther away") != std::string::npos);
  CHECK(messageOf({.period = {0, 3, 0}, .repeats = 2}) == "");
  CHECK(messageOf({.mirrors = {std::vector<double>{}, std::vector<double>{}, std::vector{0.0, 3.0}}, .repeats = 2}) ==
        "");
}
