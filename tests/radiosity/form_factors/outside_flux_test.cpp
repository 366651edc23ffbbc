// outsideFlux: the light of the sky and of suns against closed forms and rays.
#include "radiosity/form_factors/outside_flux.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "radiosity/form_factors/scene_form_factors.h"
#include "raster/base/parallel.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr int directions = 2048;

Scene sceneUnder(std::vector<Surface> surfaces, OutsideLight outside) {
  Scene scene;
  scene.materials = {tests::material("grey", glm::dvec3(0.5), glm::dvec3(0))};
  scene.surfaces = std::move(surfaces);
  scene.outside = std::move(outside);
  return tests::finish(std::move(scene));
}

OutsideLight sky(const glm::dvec3& irradiance) { return {irradiance}; }
OutsideLight sun(const glm::dvec3& towards, const glm::dvec3& irradiance) {
  return {glm::dvec3(0), {{glm::normalize(towards), irradiance}}};
}

OutsideFlux fluxIn(tests::HemicubeWorld& world) {
  return outsideFlux(world.scene, world.discretization, world.layout, world.renderer, {.directions = directions});
}

struct LitFromOutside {
  tests::HemicubeWorld world;
  OutsideFlux flux;

  LitFromOutside(Scene scene, const DiscretizationSettings& settings)
      : world(std::move(scene), settings), flux(fluxIn(world)) {}

  double area(std::size_t element) const { return world.discretization.elements[element].area; }
  double irradiance(std::size_t element) const { return flux.received[element][0] / area(element); }
  /// The mean irradiance of a surface.
  double ofSurface(std::size_t surface) const {
    const Grid& grid = world.discretization.grids[surface];
    double sum = 0, areas = 0;
    for (const std::uint32_t e : elementsOf(grid)) {
      sum += flux.received[e][0];
      areas += area(e);
    }
    return sum / areas;
  }
};

/// A floor of 4 x 4 with two blocks.
std::vector<Surface> blocksOnFloor() {
  std::vector<Surface> surfaces{tests::parallelogram("floor", {-2, -2, 0}, {4, 0, 0}, {0, 4, 0})};
  for (const auto& [low, size] : {std::pair{glm::dvec3(-1, -1, 0), glm::dvec3(0.8, 0.6, 1.2)},
                                  std::pair{glm::dvec3(0.3, 0.2, 0), glm::dvec3(0.5, 1, 0.4)}}) {
    const std::vector<Surface> block = tests::box("block", low, size, false);
    surfaces.insert(surfaces.end(), block.begin() + 1, block.end());
  }
  return surfaces;
}

}  // namespace

TEST_CASE("affordableViews bounds the triangles of all views, and keeps the views of small scenes", "[outside]") {
  for (const std::size_t triangles : {0, 1, 1000, 40960}) {
    CHECK(affordableViews(2048, triangles).directions == 2048);
    CHECK(affordableViews(2048, triangles).pixelsPerElement == 16);
  }
  CHECK(affordableViews(minDirections, 1000000000).pixelsPerElement == 16);
  int directions = 2048;
  for (std::size_t triangles = 50000; triangles < 10000000; triangles *= 2) {
    const OutsideViews views = affordableViews(2048, triangles);
    CHECK((views.directions < directions || views.directions == minDirections));
    CHECK(static_cast<std::size_t>(views.directions) * triangles <=
          std::max<std::size_t>(5 << 24, minDirections * triangles));
    CHECK(views.pixelsPerElement == Approx(16 * std::pow(2048.0 / views.directions, 0.75)));
    directions = views.directions;
  }
}

TEST_CASE("outsideFlux lights an open plane with the irradiance of the sky, and counts its back apart",
          "[outside_flux]") {
  for (const glm::dvec3& normal :
       {glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0.6, -0.5, 0.2)}) {
    const glm::dvec3 n = glm::normalize(normal), u = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.4, 0.9)));
    const LitFromOutside lit(
        sceneUnder({tests::parallelogram("plane", {5, 6, 7}, 2.0 * u, glm::cross(n, u))}, sky({3, 2, 1})),
        {.texels = 8});
    double largest = 0;
    for (std::size_t e = 0; e < lit.flux.received.size(); ++e)
      largest = std::max(largest, std::abs(lit.irradiance(e) / 3 - 1));
    CHECK(largest < 0.02);
    CHECK(lit.ofSurface(0) == Approx(3).epsilon(0.002));
    CHECK(lit.flux.received[5][1] == Approx(lit.flux.received[5][0] * 2 / 3).epsilon(1e-12));
    CHECK(lit.flux.onBacks[0] == Approx(3 * 2).epsilon(0.002));
  }
}

TEST_CASE("outsideFlux lights every side of a box with the whole sky", "[outside_flux]") {
  const LitFromOutside lit(sceneUnder(tests::box("box", {1, 2, 3}, {1, 2, 0.5}, false), sky(glm::dvec3(1))),
                           {.texels = 6});
  for (std::size_t side = 0; side < 6; ++side) CHECK(lit.ofSurface(side) == Approx(1).epsilon(0.004));
  CHECK(lit.flux.onBacks[0] < 1e-3);
}

TEST_CASE("outsideFlux lights the floor of an open box by its form factor to the opening", "[outside_flux]") {
  std::vector<Surface> surfaces = tests::box("box", {0, 0, 0}, {3, 2, 1.5}, true);
  surfaces.erase(surfaces.begin() + 1);
  const LitFromOutside lit(sceneUnder(std::move(surfaces), sky(glm::dvec3(1))), {.texels = 15});
  CHECK(lit.ofSurface(0) == Approx(tests::parallelRectangles({{0, 3}, {0, 2}}, {{0, 3}, {0, 2}}, 1.5)).epsilon(0.004));
  // The element in the middle is small enough to compare with the form factor of its centre.
  CHECK(lit.irradiance(7 * 15 + 7) ==
        Approx(tests::elementToParallelRectangle({{-1.5, 1.5}, {-1, 1}}, 1.5)).epsilon(0.02));
  // A wall that contains an edge of the opening.
  CHECK(lit.ofSurface(3) ==
        Approx(tests::perpendicularRectangles({{0, 3}, {0, 1.5}}, {{0, 3}, {0, 2}})).epsilon(0.004));
  // Outside, the backs of the five walls see all of the sky.
  CHECK(lit.flux.onBacks[0] == Approx(3 * 2 + 2 * (3 * 1.5 + 2 * 1.5)).epsilon(0.005));
}

TEST_CASE("outsideFlux brings nothing into a closed room", "[outside_flux]") {
  OutsideLight outside = sun({1, 2, 3}, glm::dvec3(5));
  outside.sky = glm::dvec3(1);
  const LitFromOutside lit(sceneUnder(tests::box("room", {0, 0, 0}, {4, 3, 2}, true), outside), {.texels = 8});
  CHECK(areZero(lit.flux.received.values));
  CHECK(lit.flux.onBacks[0] > 52);
}

TEST_CASE("outsideFlux lights a plane by the sun with the cosine of its incidence", "[outside_flux]") {
  for (const glm::dvec3& towards : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 1), glm::dvec3(-2, 5, 0.7)}) {
    const LitFromOutside lit(
        sceneUnder({tests::parallelogram("plane", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}, sun(towards, {4, 2, 1})),
        {.texels = 8});
    CHECK(lit.ofSurface(0) == Approx(4 * glm::normalize(towards).z).epsilon(0.003));
    CHECK(areZero(lit.flux.onBacks));
  }
  const LitFromOutside below(
      sceneUnder({tests::parallelogram("plane", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}, sun({0, 1, -1}, {4, 2, 1})),
      {.texels = 8});
  CHECK(areZero(sumOf(below.flux)));
  CHECK(below.flux.onBacks[1] == Approx(2 * std::sqrt(0.5)).epsilon(0.003));
}

TEST_CASE("outsideFlux shows the edges of a shadow under the sun", "[outside_flux]") {
  // A square of side 1 at height 1 over the floor; the sun shines along (1, 0, 1), so that its shadow lies at x - 1.
  const LitFromOutside lit(sceneUnder({tests::parallelogram("floor", {-4, -2, 0}, {8, 0, 0}, {0, 4, 0}),
                                       tests::parallelogram("roof", {0.05, -0.3, 1}, {1, 0, 0}, {0, 1, 0})},
                                      sun({1, 0, 1}, glm::dvec3(std::sqrt(2)))),
                           {.surfaceTexels = {{"floor", {80, 40}}, {"roof", 4}}});
  const auto overlap = [](double low, double high, double from, double to) {
    return std::max(0.0, std::min(high, to) - std::max(low, from)) / (to - from);
  };
  double largest = 0, sum = 0;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 80; ++column) {
      const double x = -4 + 0.1 * column, y = -2 + 0.1 * row;
      const double shadow = overlap(-0.95, 0.05, x, x + 0.1) * overlap(-0.3, 0.7, y, y + 0.1);
      const double error = std::abs(lit.irradiance(static_cast<std::size_t>(80 * row + column)) - (1 - shadow));
      largest = std::max(largest, error);
      sum += error;
    }
  // The direction is exact within 1/1024 radian, 0.001 of the height.
  INFO("largest error " << largest << ", mean " << sum / 3200);
  CHECK(largest < 0.08);
  CHECK(sum / 3200 < 0.01);
}

TEST_CASE("outsideFlux agrees with rays on a floor with blocks", "[outside_flux]") {
  const LitFromOutside lit(sceneUnder(blocksOnFloor(), sky(glm::dvec3(1))), {.texels = 10});
  const Discretization& discretization = lit.world.discretization;
  const reference::RayFormFactors factors(lit.world.scene, discretization);
  const reference::Receivers elements = reference::everyElement(discretization);
  double error = 0, sum = 0;
  for (std::uint32_t e = 0; e < discretization.elements.size(); e += 3) {
    const std::vector<std::uint32_t> own{e};
    const double truth =
        factors.overHemisphere(reference::areaRaySource(factors.pieces(), own), elements, {.samples = 4096})
            .background.value *
        lit.area(e);
    error += std::abs(lit.flux.received[e][0] - truth);
    sum += truth;
  }
  CHECK(error < 0.012 * sum);
}

TEST_CASE("outsideFlux lights elements that are smaller than a pixel", "[outside_flux]") {
  // Below the roof and beside it, with 1e-5 of the floor's area each.
  const auto chip = [](const std::string& name, const glm::dvec3& at) {
    return tests::parallelogram(name, at, {0.01, 0, 0}, {0, 0.01, 0});
  };
  OutsideLight outside = sun({0, 0, 1}, glm::dvec3(2));
  outside.sky = glm::dvec3(1);
  const LitFromOutside lit(sceneUnder({tests::parallelogram("floor", {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}),
                                       tests::parallelogram("roof", {-1, -1, 0.01}, {1, 0, 0}, {0, 1, 0}),
                                       chip("dark", {-0.5, -0.5, 0.002}), chip("open", {1, 1, 0.002})},
                                      outside),
                           {.surfaceTexels = {{"floor", 32}, {"roof", 8}, {"dark", 1}, {"open", 1}}});
  CHECK(lit.ofSurface(2) < 0.001);
  CHECK(lit.ofSurface(3) == Approx(3).epsilon(0.01));
}

TEST_CASE("outsideFlux lights both sides of two-sided sheets", "[outside_flux]") {
  std::vector<Surface> surfaces{tests::parallelogram("top", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("bottom", {0, 0, 0}, {0, 1, 0}, {1, 0, 0})};
  makeTwins(surfaces, 0, 1);
  OutsideLight outside = sun({0, 0, 1}, glm::dvec3(2));
  outside.sky = glm::dvec3(1);
  const LitFromOutside lit(sceneUnder(std::move(surfaces), outside), {.texels = 4});
  CHECK(lit.ofSurface(0) == Approx(3).epsilon(0.004));
  CHECK(lit.ofSurface(1) == Approx(1).epsilon(0.004));
  CHECK(areZero(lit.flux.onBacks));
}

TEST_CASE("outsideFlux has the same bits for any number of threads, and for textures and meshes", "[outside_flux]") {
  OutsideLight outside = sun({1, 2, 3}, glm::dvec3(5));
  outside.sky = {1, 2, 3};
  tests::HemicubeWorld world(sceneUnder(blocksOnFloor(), outside), 8, 4);
  const OutsideFlux flux = fluxIn(world);
  const raster::ThreadLimit one(1);
  const OutsideFlux again = fluxIn(world);
  CHECK(flux.received == again.received);
  CHECK(flux.onBacks == again.onBacks);
  const auto mesh = sceneRenderer(world.scene, world.discretization, world.layout, ElementsBy::Mesh);
  const OutsideFlux meshed =
      outsideFlux(world.scene, world.discretization, world.layout, *mesh, {.directions = directions});
  CHECK(std::abs(sumOf(meshed)[0] - sumOf(flux)[0]) < 1e-3 * sumOf(flux)[0]);
}

TEST_CASE("outsideFlux is empty without light from outside", "[outside_flux]") {
  const LitFromOutside lit(sceneUnder(blocksOnFloor(), {}), {.texels = 2});
  CHECK(lit.flux.received.empty());
  CHECK(sumOf(lit.flux).empty());
}

TEST_CASE("Light from outside counts where it is enclosed", "[outside flux]") {
  // An open box with the opening at its top, and a roof over it that sees nothing but the sky.
  const auto countedIn = [](bool hasBox, bool hasRoof, bool isClosed = false) {
    std::vector<Surface> surfaces;
    if (hasBox) surfaces = tests::box("wall", {0, 0, 0}, {1, 1, 1}, true);
    if (!isClosed)
      std::erase_if(surfaces, [](const Surface& surface) { return normal(surface.triangles[0]).z < -0.5; });
    if (hasRoof) surfaces.push_back(tests::parallelogram("roof", {-10, -10, 9}, {20, 0, 0}, {0, 20, 0}));
    const Scene scene = sceneUnder(std::move(surfaces), sky(glm::dvec3(1)));
    Discretization discretization = discretize(scene, {.texels = 8});
    return SceneFormFactors(scene, discretization, layOut(discretization), {.resolution = 64}).outsideFlux().counted;
  };
  CHECK(countedIn(false, true) == leastCounted);
  // Grey walls reflect a half of the light, of which more than a half and less than nine tenths meet other walls.
  const double ofBox = countedIn(true, false);
  CHECK(ofBox > 0.25);
  CHECK(ofBox < 0.45);
  // The roof receives 400 times the light of the opening.
  CHECK(countedIn(true, true) == leastCounted);
  CHECK(countedIn(true, false, true) == leastCounted);  // no light enters
}
