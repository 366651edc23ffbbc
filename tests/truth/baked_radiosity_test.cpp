// bakedRadiosity (light tracing) compared with closed forms.
#include "tests/truth/baked_radiosity.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/truth_table.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// Four standard errors. One of about 10,000 random checks would fail; the seeds are fixed.
constexpr double deviations = 4;

glm::dvec3 fluxOf(const BakedRadiosity& baked) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& flux : baked.flux) sum += flux;
  return sum;
}

/// A square of 1 m that emits, facing down at height 1 above a floor of 3 m by 3 m.
Scene lampOverFloor() {
  Scene scene = tests::sceneOf({tests::parallelogram("floor", {-1, -1, 0}, {3, 0, 0}, {0, 3, 0}),
                                tests::quad("lamp", {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}, 1)});
  scene.materials = {tests::material("grey", glm::dvec3(0.5), glm::dvec3(0)),
                     tests::material("light", glm::dvec3(0), {1, 2, 4})};
  return scene;
}

/// A closed room of 4 m x 3 m x 2 m that emits everywhere, with a box on its floor. The box [low, low + size] has a
/// bottom or none.
Scene roomWithBox(const glm::dvec3& low, const glm::dvec3& size, bool hasBottom) {
  std::vector<Surface> surfaces = tests::box("room", {0, 0, 0}, {4, 3, 2}, true);
  const std::vector<Surface> box = tests::box("box", low, size, false);
  surfaces.insert(surfaces.end(), box.begin() + (hasBottom ? 0 : 1), box.end());
  Scene scene = tests::sceneOf(std::move(surfaces));
  scene.materials = {tests::material("grey", glm::dvec3(0.5), glm::dvec3(1))};
  return scene;
}

double exposedAreaOf(const Scene& scene, const BakedRadiosity& baked, const std::string& name) {
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    if (scene.surfaces[s].name == name) return baked.surfaces[s].exposedArea;
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("bakedRadiosity under a sky is the share of the sky that is seen, within its standard errors", "[baked]") {
  // The floor of an open shaft with black walls sees the sky through the opening, which is an opposite rectangle.
  constexpr double width = 2, depth = 3, height = 1.5;
  std::vector<Surface> shaft = tests::box("shaft", {0, 0, 0}, {width, depth, height}, true);
  const auto isOpening = [](const Surface& surface) { return normal(surface.triangles.front()).z < -0.5; };
  std::erase_if(shaft, isOpening);
  Scene scene = tests::sceneOf(std::move(shaft));
  scene.materials = {tests::material("black", glm::dvec3(0), glm::dvec3(0))};
  const auto floor = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                  [](const Surface& surface) { return normal(surface.triangles.front()).z > 0.5; });
  floor->material = 1;
  scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(0)));
  scene.outside.sky = {1, 2, 3};
  const Discretization discretization = discretizeUnburied(scene, {.texels = 1});
  const BakedRadiosity baked = bakedRadiosity(scene, discretization);
  const SurfaceFlux& of = baked.surfaces[static_cast<std::size_t>(floor - scene.surfaces.begin())];
  const double seen = parallelRectangles({{0, width}, {0, depth}}, {{0, width}, {0, depth}}, height);
  for (int band = 0; band < 3; ++band) {
    const double expected = 0.5 * scene.outside.sky[band] * width * depth * seen;
    CHECK(std::abs(of.flux[band] - expected) <= deviations * of.fluxError[band]);
    CHECK(of.fluxError[band] < 0.02 * expected);
  }
}

TEST_CASE("bakedRadiosity of a furnace is E over 1 minus r, within its standard errors", "[baked]") {
  const Scene scene = tests::closedCube(glm::dvec3(0.25, 0.5, 0.75), glm::dvec3(1, 2, 3));
  const Discretization discretization = discretizeUnburied(scene, {.texels = 4});
  const BakedRadiosity baked = bakedRadiosity(scene, discretization, {.paths = 1 << 17, .points = 32});
  const glm::dvec3 exact(1 / 0.75, 2 / 0.5, 3 / 0.25);
  double squares = 0;
  for (std::size_t e = 0; e < baked.radiosity.size(); ++e) {
    CHECK(baked.exposedArea[e] == Approx(discretization.elements[e].area).epsilon(1e-12));
    for (int band = 0; band < 3; ++band) {
      const double deviation = (baked.radiosity[e][band] - exact[band]) / baked.radiosityError[e][band];
      squares += deviation * deviation;
      CHECK(baked.radiosityError[e][band] < 0.05 * exact[band]);
    }
  }
  // The mean square of 288 deviations in standard errors is at most 1, with an error of 0.1 (more, because bands share
  // paths). Blocks of the sequence complement each other, which standard errors do not include.
  CHECK(squares / 288 < 1.35);
  CHECK(squares / 288 > 0.35);
  const glm::dvec3 flux = fluxOf(baked);
  for (int band = 0; band < 3; ++band) CHECK(flux[band] == Approx(6 * exact[band]).epsilon(3e-3));
}

TEST_CASE("bakedRadiosity of a floor under a light is the closed form", "[baked]") {
  const Scene scene = lampOverFloor();
  const Discretization discretization = discretizeUnburied(scene, {.texels = 3});
  const BakedRadiosity baked = bakedRadiosity(scene, discretization, {.paths = 1 << 18, .points = 32});
  for (std::uint32_t e = 0; e < 9; ++e) {
    const double x = e % 3 - 1.0, y = e / 3 - 1.0;
    const double factor = parallelRectangles({{x, x + 1}, {y, y + 1}}, {{0, 1}, {0, 1}}, 1);
    const glm::dvec3 exact = 0.5 * factor * glm::dvec3(1, 2, 4);
    for (int band = 0; band < 3; ++band) {
      CHECK(std::abs(baked.radiosity[e][band] - exact[band]) < deviations * baked.radiosityError[e][band]);
      CHECK(baked.radiosityError[e][band] < 0.01 * exact[band]);
    }
  }
  CHECK(baked.radiosity.back() == glm::dvec3(1, 2, 4));
}

TEST_CASE("bakedRadiosity exposes a floor except for the footprint of a box that stands on it", "[baked]") {
  const bool hasBottom = GENERATE(false, true);
  const Scene scene = roomWithBox({1, 1, 0}, {1.1, 0.7, 0.9}, hasBottom);
  const Discretization discretization = discretizeUnburied(scene, {.texels = 8});
  const BakedRadiosity baked = bakedRadiosity(scene, discretization, {.paths = 32, .points = 256});
  CHECK(exposedAreaOf(scene, baked, "room0") == Approx(12 - 1.1 * 0.7).margin(1e-2));
  CHECK(exposedAreaOf(scene, baked, "room1") == Approx(12).epsilon(1e-12));
  CHECK(exposedAreaOf(scene, baked, "box1") == Approx(1.1 * 0.7).epsilon(1e-12));
  if (hasBottom) CHECK(exposedAreaOf(scene, baked, "box0") == 0);
  // Two elements of the floor lie completely under the box, where no light leaves them.
  int dark = 0;
  for (std::size_t e = 0; e < 64; ++e) {
    if (baked.exposedArea[e] > 0) continue;
    ++dark;
    CHECK(baked.radiosity[e] == glm::dvec3(0));
    CHECK(baked.flux[e] == glm::dvec3(0));
  }
  CHECK(dark == 2);
}

TEST_CASE("bakedRadiosity exposes hovering objects, and not parts sunk into the floor", "[baked]") {
  const Scene hovering = roomWithBox({1, 1, 1e-3}, {1, 1, 1}, true);
  const BakedRadiosity one =
      bakedRadiosity(hovering, discretizeUnburied(hovering, {.texels = 2}), {.paths = 32, .points = 32});
  CHECK(exposedAreaOf(hovering, one, "room0") == Approx(12).epsilon(1e-12));
  CHECK(exposedAreaOf(hovering, one, "box0") == Approx(1).epsilon(1e-12));
  const Scene sunk = roomWithBox({1, 1, -0.25}, {1, 1, 1}, true);
  const BakedRadiosity other =
      bakedRadiosity(sunk, discretizeUnburied(sunk, {.texels = 2}), {.paths = 32, .points = 1 << 12});
  CHECK(exposedAreaOf(sunk, other, "room0") == Approx(11).margin(1e-2));
  CHECK(exposedAreaOf(sunk, other, "box2") == Approx(0.75).margin(5e-3));
}

// In a closed room the emitted flux equals the absorbed flux, which is the arriving flux times 1 - r per element.
TEST_CASE("bakedRadiosity keeps the balance of energy in a closed room with a box", "[baked]") {
  const Scene scene = roomWithBox({1, 1, 0}, {1, 1, 1}, false);
  const Discretization discretization = discretizeUnburied(scene, {.texels = 4});
  const BakedRadiosity baked = bakedRadiosity(scene, discretization, {.paths = 1 << 18});
  double emitted = 0, absorbed = 0;
  for (std::size_t e = 0; e < baked.flux.size(); ++e) {
    emitted += baked.exposedArea[e];
    absorbed += (baked.flux[e].r - baked.exposedArea[e]) / 0.5 * (1 - 0.5);
  }
  CHECK(emitted == Approx(52 + 4).epsilon(1e-3));
  CHECK(absorbed == Approx(emitted).epsilon(3e-3));
}

TEST_CASE("bakedRadiosity gives the same bits for any number of threads, and others for other seeds", "[baked]") {
  const Scene scene = lampOverFloor();
  const Discretization discretization = discretizeUnburied(scene, {.texels = 3});
  const auto fluxes = [&](int threads, std::uint32_t seed) {
    const raster::ThreadLimit limit(threads);
    return bakedRadiosity(scene, discretization, {.paths = 1 << 12, .points = 32, .seed = seed}).flux;
  };
  const std::vector<glm::dvec3> one = fluxes(1, 0);
  CHECK(fluxes(3, 0) == one);
  CHECK(fluxes(1, 1) != one);
}

TEST_CASE("bakedRadiosity throws InputError for numbers other than 32 times a power of two", "[baked]") {
  const Scene scene = lampOverFloor();
  const Discretization discretization = discretizeUnburied(scene, {.texels = 1});
  for (const int paths : {0, 31, 96, 100})
    CHECK_THROWS_AS(bakedRadiosity(scene, discretization, {.paths = paths}), raster::InputError);
}

TEST_CASE("bakedRadiosity of a scene without light is dark", "[baked]") {
  Scene scene = lampOverFloor();
  scene.materials[1].emission = glm::dvec3(0);
  const BakedRadiosity baked = bakedRadiosity(scene, discretizeUnburied(scene, {.texels = 2}), {.paths = 64});
  CHECK(fluxOf(baked) == glm::dvec3(0));
}

// A box without bottom and back, in front of a wall: inside, floor and wall see each other.
TEST_CASE("bakedRadiosity buries the space that a box encloses with the floor and a wall", "[baked]") {
  std::vector<Surface> surfaces = tests::box("room", {0, 0, 0}, {4, 3, 2}, true);
  const std::vector<Surface> box = tests::box("box", {1, 0, 0}, {1, 0.75, 0.5}, false);
  for (const std::size_t face : {1U, 2U, 3U, 5U}) surfaces.push_back(box[face]);
  Scene scene = tests::sceneOf(std::move(surfaces));
  scene.materials = {tests::material("grey", glm::dvec3(0.5), glm::dvec3(0)),
                     tests::material("light", glm::dvec3(0.5), glm::dvec3(1))};
  scene.surfaces[1].material = 1;  // the ceiling
  const BakedRadiosity baked =
      bakedRadiosity(scene, discretizeUnburied(scene, {.texels = 4}), {.paths = 32, .points = 1024});
  CHECK(exposedAreaOf(scene, baked, "room0") == Approx(12 - 0.75).margin(5e-3));
  CHECK(exposedAreaOf(scene, baked, "room4") == Approx(8 - 0.5).margin(5e-3));
  CHECK(exposedAreaOf(scene, baked, "box1") == Approx(0.75).epsilon(1e-12));
}

// The table was made manually (tests/truth/main.cpp); areas are those of the scene without common areas.
TEST_CASE("readTruthTable reads the truth of the furnished room, whose errors are as small as promised", "[baked]") {
  const tests::TruthTable table = tests::readTruthTable(HEMITEX_DATA "/furnished-room.truth.csv");
  const Scene scene = loadScene(HEMITEX_DATA "/furnished-room.obj");
  CHECK(table.size() == scene.surfaces.size());
  glm::dvec3 emitted(0);
  for (const Surface& surface : scene.surfaces) {
    const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    emitted += material.emission * table.at(surface.name).exposedArea;
  }
  for (const auto& [name, of] : table) {
    INFO(name);
    for (int band = 0; band < 3; ++band)
      CHECK(of.fluxError[band] <= std::max(2e-3 * of.flux[band], 2e-5 * emitted[band]));
  }
  const auto checkArea = [&](const std::string& name, double area) {
    const SurfaceFlux& of = table.at(name);
    CHECK(of.exposedArea == Approx(area).margin(1e-9 + deviations * of.exposedAreaError));
  };
  checkArea("floor", 20 - 3.91 - 0.09 - 0.49 - 0.25 - 0.015);
  checkArea("ceiling", 20 - 0.7);
  checkArea("wall-back", 10.4 - 0.42 - 5 * 0.02875 - 0.1 - 0.1289);
  checkArea("table-top-bottom", 1.44 - 4 * 0.0036);
  checkArea("picture-left", 0);
  checkArea("crate-bottom", 0);
}
