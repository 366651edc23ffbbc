/// A solution that goes on from a snapshot has the bits of one that was never stopped.
#include "radiosity/solver/snapshot.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A closed cube with a small square light below its ceiling, in parallel light and light from all sides.
Scene litCube() {
  Scene scene = tests::closedCube(glm::dvec3(0.7, 0.5, 0.3), glm::dvec3(0));
  scene.materials.push_back(tests::material("light", glm::dvec3(0.5), glm::dvec3(10, 20, 30)));
  scene.surfaces.push_back(tests::parallelogram("light", {0.4, 0.75, 0.3}, {0.2, 0, 0}, {0, 0, 0.3}));
  scene.surfaces.back().material = 1;
  scene.surfaces.erase(scene.surfaces.begin());  // an opening, for the light from outside
  scene.outside = {glm::dvec3(1, 2, 3), {{glm::dvec3(0, 0, 1), glm::dvec3(3, 2, 1)}}};
  return tests::finish(std::move(scene));
}

constexpr SolverSettings exactSettings{.residual = 1e-5};

/// Solves from the start or from the bytes of a snapshot.
Solution solutionOf(const Scene& scene, const Progress& progress, std::string_view bytes = {}) {
  const Discretization discretization = discretize(scene, {.texels = 8, .patch = 4});
  SceneFormFactors drawn(scene, discretization, layOut(discretization), {.resolution = 32, .split = 0.01});
  Snapshot snapshot;
  if (!bytes.empty()) snapshot = takeSnapshot(bytes);
  CHECK(bytes.empty());
  return solve({.scene = scene,
                .discretization = discretization,
                .patches = discretization.patches,
                .rowOf = drawn.rowOf(),
                .split = drawn.splits(),
                .settings = exactSettings,
                .outside = drawn.outsideFlux(),
                .snapshot = snapshot.shots > 0 ? &snapshot : nullptr},
               progress);
}

void checkEqual(const Solution& a, const Solution& b) {
  CHECK(a.radiosity == b.radiosity);
  CHECK(a.ambient == b.ambient);
  CHECK(a.shots == b.shots);
  CHECK(a.residual == b.residual);
  CHECK(a.warnings == b.warnings);
  CHECK(a.absorbedByBacks == b.absorbedByBacks);
  for (const auto flux : {&Energy::emitted, &Energy::absorbed, &Energy::unshot, &Energy::lost, &Energy::lostToBacks})
    CHECK(a.energy.*flux == b.energy.*flux);
}

}  // namespace

TEST_CASE("A solution goes on from any of its snapshots with the same bits", "[snapshot]") {
  const Scene scene = litCube();
  std::vector<std::string> snapshots;
  const Solution whole = solutionOf(scene, [&](const Step& step) {
    if (step.shots % 37 == 1) snapshots.push_back(toBytes(step.snapshot()));
    return true;
  });
  REQUIRE(snapshots.size() > 5);
  std::string_view last = snapshots.back();
  CHECK_FALSE(takeSnapshot(last).splits.empty());
  for (const std::string& bytes : snapshots)
    checkEqual(solutionOf(
                   scene, [](const Step&) { return true; }, bytes),
               whole);
}

TEST_CASE("A solution that progress ends says so, unless it was at its limit", "[snapshot]") {
  const Scene scene = litCube();
  std::string bytes;
  const auto stopAt = [&](int shots) {
    return [&bytes, shots](const Step& step) {
      bytes = toBytes(step.snapshot());
      return step.shots < shots;
    };
  };
  const Solution stopped = solutionOf(scene, stopAt(10));
  CHECK(stopped.isInterrupted);
  CHECK(stopped.shots == 10);
  const Solution whole = solutionOf(scene, stopAt(1 << 30), bytes);
  CHECK_FALSE(whole.isInterrupted);
  CHECK_FALSE(solutionOf(scene, stopAt(whole.shots)).isInterrupted);
}

TEST_CASE("Snapshots that are cut off or of another scene are refused", "[snapshot]") {
  const Scene scene = litCube();
  std::string bytes;
  solutionOf(scene, [&](const Step& step) {
    bytes = toBytes(step.snapshot());
    return step.shots < 20;
  });
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 16) {
    std::string_view cut = std::string_view(bytes).substr(0, length);
    CHECK_THROWS_AS(takeSnapshot(cut), raster::InputError);
  }
  Scene other = scene;
  other.surfaces.pop_back();
  other.materials[0].emission = glm::dvec3(1);
  CHECK_THROWS_AS(solutionOf(
                      other, [](const Step&) { return true; }, bytes),
                  raster::InputError);
}
