#include "tests/accuracy/solution_cases.h"

#include <algorithm>
#include <cmath>

#include "radiosity/solver/progressive_solver.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"

namespace hemitex::accuracy {
namespace {

using namespace radiosity;

Solution solutionOf(tests::HemicubeWorld& world, int resolution, const Progress& progress) {
  ProjectedFormFactors rows = world.rows(resolution);
  return solve({.scene = world.scene,
                .discretization = world.discretization,
                .patches = world.discretization.patches,
                .rowOf = [&](const radiosity::Patch& patch) { return rows.ofPatch(patch); }},
               progress);
}

double accountErrorOf(const Energy& energy) {
  return std::abs(energy.absorbed[0] + energy.unshot[0] + energy.lost[0] - energy.emitted[0]) / energy.emitted[0];
}

/// The light is a square that faces down, a quarter below the ceiling.
Scene litCube(const EmissionCase& example) {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.materials.push_back(tests::material("light", glm::dvec3(0.5), glm::dvec3(example.emission)));
  const double side = std::sqrt(6 * example.share / (1 - example.share));
  scene.surfaces.push_back(tests::parallelogram("light", {0.4, 0.75, 0.3}, {side, 0, 0}, {0, 0, side}));
  scene.surfaces.back().material = 1;
  return tests::finish(std::move(scene));
}

}  // namespace

std::vector<FurnaceCase> furnaces() { return {{0}, {0.5}, {0.9}, {0.99}, {0.999}, {0.9999}}; }

FurnaceFindings findingsOf(const FurnaceCase& furnace) {
  const double r = furnace.reflectance;
  tests::HemicubeWorld world(tests::closedCube(glm::dvec3(r), glm::dvec3(1)), 2, 2);
  FurnaceFindings findings{};
  double before = 1;
  const Solution solution = solutionOf(world, 32, [&](const Step& step) {
    findings.grew |= step.residual > before;
    before = step.residual;
    return true;
  });
  double area = 0, flux = 0;
  for (std::size_t e = 0; e < solution.radiosity.size(); ++e) {
    area += world.discretization.elements[e].area;
    flux += world.discretization.elements[e].area * solution.radiosity[e].x;
  }
  findings.shots = solution.shots;
  findings.meanError = std::abs(flux / area * (1 - r) / (1 - r * solution.residual) - 1);
  findings.accountError = accountErrorOf(solution.energy);
  return findings;
}

std::vector<EmissionCase> emissions() { return {{1e-30, 0.01}, {1e30, 0.01}, {1, 1e-8}, {1e30, 1e-8}}; }

EmissionFindings findingsOf(const EmissionCase& emission) {
  tests::HemicubeWorld world(litCube(emission), 8, 4), one(litCube({1, emission.share}), 8, 4);
  const Solution solution = solutionOf(world, 64, {}), expected = solutionOf(one, 64, {});
  EmissionFindings findings{0, accountErrorOf(solution.energy)};
  for (std::size_t e = 0; e < expected.radiosity.size(); ++e)
    if (expected.radiosity[e].x > 0)
      findings.linearityError = std::max(
          findings.linearityError, std::abs(solution.radiosity[e].x / emission.emission / expected.radiosity[e].x - 1));
  return findings;
}

}  // namespace hemitex::accuracy
