// Default solutions of scenes compared with light tracing (tests/truth/scenes, data/furnished-room.truth.csv).
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "tests/support/truth_table.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A scene with light-traced truth, and what the default solution keeps. Bounds are about twice what was measured. The
/// errors of surfaces come on top of four standard errors of light tracing.
struct TruthScene {
  std::string path;         ///< without ".obj"
  glm::dvec3 sky{0.0};      ///< W/m^2 per band, as in the first line of the table
  std::string family = "";  ///< prefix of the names of the surfaces whose light is measured
  double error = 0;         ///< of the sum of flux differences of these surfaces, over their flux
  double surfaceError = 0;  ///< of the flux difference of each, over its flux
  double lostToBacks = 0;   ///< of the flux that backs absorb, over the emitted flux
  /// Prefixes of the names of surfaces with errors up to `exceptionError`: small faces in dark corners and narrow gaps,
  /// which see the light of elements larger than the corner.
  std::vector<std::string> exceptions = {};
  double exceptionError = 0;
};

Solution solvedByDefault(const Scene& scene, Discretization& discretization) {
  discretization = discretize(scene, {});
  SceneFormFactors drawn(scene, discretization, layOut(discretization), {});
  OutsideFlux outside = drawn.outsideFlux();
  return solve({.scene = scene,
                .discretization = discretization,
                .patches = discretization.patches,
                .rowOf = drawn.rowOf(),
                .split = drawn.splits(),
                .settings = {.residual = defaultResidual(scene, discretization, outside)},
                .outside = std::move(outside)});
}

bool startsWith(const std::string& name, const std::string& prefix) {
  return name.compare(0, prefix.size(), prefix) == 0;
}

void compare(const TruthScene& expected, const Scene& scene, const tests::TruthTable& truth,
             const Discretization& discretization, const Solution& solution) {
  double difference = 0, all = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const std::string& name = scene.surfaces[s].name;
    if (!startsWith(name, expected.family)) continue;
    glm::dvec3 flux(0);
    for (const std::uint32_t e : elementsOf(discretization.grids[s]))
      flux += discretization.elements[e].area * solution.radiosity[e];
    const double traced = bandSum(truth.at(name).flux), tracingError = bandSum(truth.at(name).fluxError);
    const bool isException = std::any_of(expected.exceptions.begin(), expected.exceptions.end(),
                                         [&](const std::string& prefix) { return startsWith(name, prefix); });
    CAPTURE(name, bandSum(flux), traced, tracingError, bandSum(flux) / traced);
    CHECK(std::abs(bandSum(flux) - traced) <=
          (isException ? expected.exceptionError : expected.surfaceError) * traced + 4 * tracingError);
    difference += std::abs(bandSum(flux) - traced);
    all += traced;
  }
  CAPTURE(difference / all);
  CHECK(difference <= expected.error * all);
}

const std::string folderOfScenes = HEMITEX_SOURCE "/tests/truth/scenes/";

}  // namespace

TEST_CASE("solve agrees with light tracing in scenes of many kinds", "[truth-scenes]") {
  const TruthScene expected = GENERATE(values<TruthScene>(
      {{HEMITEX_DATA "/furnished-room", {}, "", 0.003, 0.07, 2e-4, {"shelf-board-1-bottom", "rug-edges"}, 0.5},
       // The lamp of these is a sheet 10 cm below the ceiling, whose back absorbs 1 %.
       {folderOfScenes + "ball", {}, "", 0.005, 0.02, 0.012},
       {folderOfScenes + "displaced", {}, "", 0.003, 0.04, 0.012, {"blob"}, 0.12},
       {folderOfScenes + "attic", {}, "", 0.003, 0.04, 0.012},
       {folderOfScenes + "thin", {}, "", 0.003, 0.04, 4e-4, {"book", "picture", "lamp-", "rug"}, 0.25},
       {folderOfScenes + "block", {10, 10, 12}, "", 0.002, 0.02, 2e-4},
       // The rooms of the flat, and the reveals of its windows. Light tracing of single surfaces is accurate to 0.4 %.
       {folderOfScenes + "flat", {10, 10, 12}, "a_", 0.01, 0.04, 2e-4, {"a_bed", "a_desk"}, 1.5},
       {folderOfScenes + "flat", {10, 10, 12}, "b_", 0.005, 0.04, 2e-4, {"b_sofa"}, 0.3},
       {folderOfScenes + "flat", {10, 10, 12}, "opening", 0.01, 0.04, 2e-4}}));
  CAPTURE(expected.path, expected.family);
  Scene scene = loadScene(expected.path + ".obj", {.sides = Sides::TwoOfSheets});
  scene.outside.sky = expected.sky;
  Discretization discretization;
  const Solution solution = solvedByDefault(scene, discretization);
  CHECK(bandSum(solution.energy.lostToBacks) <= expected.lostToBacks * bandSum(solution.energy.emitted));
  compare(expected, scene, tests::readTruthTable(expected.path + ".truth.csv"), discretization, solution);
}

TEST_CASE("Elements within 10 cm of a lamp have its light to 1 %", "[truth-scenes]") {
  const Scene scene = loadScene(folderOfScenes + "kitchen.obj", {.sides = Sides::TwoOfSheets});
  Discretization discretization;
  const Solution solution = solvedByDefault(scene, discretization);
  const auto numberOf = [&](const std::string& name, std::uint32_t column, std::uint32_t row) {
    const auto surface = std::ranges::find(scene.surfaces, name, &Surface::name);
    const Grid& grid = discretization.grids[static_cast<std::size_t>(surface - scene.surfaces.begin())];
    return grid.elementOfTexel[row * static_cast<std::uint32_t>(grid.columns) + column];
  };
  std::ifstream file(folderOfScenes + "kitchen.truth.csv");
  std::string line, name;
  std::getline(file, line);
  std::getline(file, line);
  REQUIRE(line == "surface,column,row,flux,error");
  double difference = 0, all = 0;
  while (std::getline(file, name, ',')) {
    std::uint32_t column = 0, row = 0;
    double traced = 0, tracingError = 0;
    char comma = 0;
    REQUIRE(file >> column >> comma >> row >> comma >> traced >> comma >> tracingError >> std::ws);
    const std::uint32_t element = numberOf(name, column, row);
    const double flux = discretization.elements[element].area * bandSum(solution.radiosity[element]);
    CAPTURE(name, column, row, flux / traced);
    CHECK(std::abs(flux - traced) <= 0.01 * traced + 4 * tracingError);
    difference += std::abs(flux - traced);
    all += traced;
  }
  CHECK(all > 0);
  CHECK(difference <= 0.003 * all);
}
