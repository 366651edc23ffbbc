// backAbsorption: which surfaces' backs absorb the light that the solution loses to backs.
#include "radiosity/light/back_absorption.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A closed cube whose floor emits, with sheets whose backs look down.
Scene cubeWithSheets(const std::vector<Surface>& sheets) {
  Scene scene = tests::closedCube({0.5, 0.4, 0.3}, glm::dvec3(0));
  scene.materials.push_back(tests::material("light", glm::dvec3(0.1), {3, 2, 1}));
  scene.surfaces[2].material = 1;
  scene.surfaces.insert(scene.surfaces.end(), sheets.begin(), sheets.end());
  return tests::finish(scene);
}

/// A horizontal sheet that faces up.
Surface sheet(const std::string& name, double x0, double x1, double y) {
  return tests::quad(name, {{{x0, y, 0.3}, {x0, y, 0.7}, {x1, y, 0.7}, {x1, y, 0.3}}});
}

struct Lost {
  Solution solution;
  BackAbsorption absorption;
};

Lost lostIn(const Scene& scene, std::size_t maxPatches = 1000) {
  const DrawingSettings settings{.resolution = 128};
  Discretization unsplit = discretize(scene, {.texels = 4, .patch = 2});
  const IdLayout layout = layOut(unsplit);
  SceneFormFactors drawn(scene, unsplit, layout, settings);
  Lost lost;
  lost.solution = solve({.scene = scene,
                         .discretization = unsplit,
                         .patches = unsplit.patches,
                         .rowOf = drawn.rowOf(),
                         .split = drawn.splits()});
  unsplit.patches = lost.solution.patches;
  lost.absorption = backAbsorption(scene, unsplit, layout, settings, lost.solution.absorbedByBacks, maxPatches);
  return lost;
}

glm::dvec3 colour(const Bands& bands) { return {bands[0], bands[1], bands[2]}; }

double difference(const glm::dvec3& a, const glm::dvec3& b) { return bandSum(glm::abs(a - b)) / bandSum(glm::abs(b)); }

}  // namespace

TEST_CASE("backAbsorption gives all flux that backs absorb to the only sheet that shows its back", "[form factors]") {
  const Lost lost = lostIn(cubeWithSheets({sheet("sheet", 0.3, 0.7, 0.5)}));
  const Energy& energy = lost.solution.energy;
  REQUIRE(bandSum(energy.lostToBacks) > 0.05 * bandSum(energy.emitted));
  CHECK(difference(lost.absorption.ofSurfaces.back(), colour(energy.lostToBacks)) < 1e-12);
  for (std::size_t s = 0; s + 1 < lost.absorption.ofSurfaces.size(); ++s)
    CHECK(lost.absorption.ofSurfaces[s] == glm::dvec3(0));
  glm::dvec3 sum(0);
  for (const glm::dvec3& flux : lost.solution.absorbedByBacks) sum += flux;
  CHECK(difference(sum, colour(energy.lostToBacks)) < 1e-12);
}

TEST_CASE("backAbsorption divides the flux between sheets as the light that reaches them", "[form factors]") {
  // Mirror images receive the same light. The third sheet lies right above the first, which hides it from the floor.
  const Lost lost = lostIn(
      cubeWithSheets({sheet("left", 0.1, 0.4, 0.4), sheet("right", 0.6, 0.9, 0.4), sheet("hidden", 0.1, 0.4, 0.41)}));
  const std::vector<glm::dvec3>& absorbed = lost.absorption.ofSurfaces;
  REQUIRE(absorbed.size() == 9);
  CHECK(difference(absorbed[6], absorbed[7]) < 0.02);
  CHECK(bandSum(absorbed[8]) < 0.05 * bandSum(absorbed[6]));
  CHECK(difference(absorbed[6] + absorbed[7] + absorbed[8], colour(lost.solution.energy.lostToBacks)) < 1e-12);
}

TEST_CASE("backAbsorption has the same bits for any number of threads, and leaves patches out above its limit",
          "[form factors]") {
  const Scene scene = cubeWithSheets({sheet("sheet", 0.3, 0.7, 0.5)});
  const auto withThreads = [&](int threads) {
    const raster::ThreadLimit limit(threads);
    return lostIn(scene).absorption.ofSurfaces;
  };
  const std::vector<glm::dvec3> one = withThreads(1);
  CHECK(withThreads(2) == one);
  const Lost few = lostIn(scene, 2);
  CHECK(few.absorption.patches == 2);
  CHECK(bandSum(few.absorption.ofSurfaces.back()) < bandSum(one.back()));
}

TEST_CASE("backAbsorption of a solution that loses nothing to backs is zero", "[form factors]") {
  const Lost lost = lostIn(cubeWithSheets({}));
  CHECK(areZero(lost.solution.energy.lostToBacks));
  CHECK(lost.absorption.patches == 0);
}
