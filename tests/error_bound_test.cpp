// Settings for a bound on the error: what is chosen, and that it keeps the bound.
#include "reference/error_bound.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "radiosity/patch_splitting.h"
#include "radiosity/projected_rows.h"
#include "radiosity/solver.h"
#include "raster/input_error.h"
#include "reference/radiosity_error.h"
#include "reference/true_radiosity.h"
#include "tests/hand_scenes.h"
#include "tests/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;

namespace {

Scene squares(int count) {
  Scene scene;
  scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(1)));
  for (int i = 0; i < count; ++i)
    scene.surfaces.push_back(tests::parallelogram("square-" + std::to_string(i), {0, 0, i}, {1, 0, 0}, {0, 1, 0}));
  return tests::finish(std::move(scene));
}

/// The column of an element's texel.
int columnOf(const Discretization& discretization, std::size_t element) {
  const Element& e = discretization.elements[element];
  return static_cast<int>(e.texel) % discretization.grids[e.surface].columns;
}

/// Solutions whose difference is a share of all light: every other element gets more, the others less.
SolveWith solutionsThatDiffer(std::size_t elements, double difference) {
  return [=](const Effort& effort) {
    std::vector<glm::dvec3> radiosity(elements, glm::dvec3(1));
    if (effort.resolution == 64)
      for (std::size_t e = 0; e < elements; ++e) radiosity[e] *= e % 2 == 0 ? 1 + difference : 1 - difference;
    return radiosity;
  };
}

Solution solutionOf(const Scene& scene, const DiscretizationSettings& settings, const Effort& effort, double residual) {
  tests::HemicubeWorld world(scene, settings);
  world.discretization =
      splitPatches(world.scene, std::move(world.discretization), world.layout, world.renderer, effort.split);
  ProjectedRows rows(world.scene, world.discretization, world.layout, world.renderer,
                     {effort.resolution, Orientation::Turned});
  return solve(world.scene, world.discretization, [&](std::uint32_t p) { return rows.ofPatch(p); },
               {.residual = residual});
}

DiscretizationSettings settingsFor(int texels, const Effort& effort) {
  return {.texels = texels, .patches = effort.patches};
}

}  // namespace

TEST_CASE("A surface of constant radiosity needs no index map", "[error_bound]") {
  const Scene scene = squares(2);
  const Discretization finest = discretize(scene, {.texels = 8});
  std::vector<glm::dvec3> radiosity(finest.elements.size(), glm::dvec3(1));
  radiosity.back() = glm::dvec3(2);
  const auto coarser = coarserMaps(scene, finest, 8, 1, radiosity, 0);
  CHECK(coarser == std::map<std::string, int>{{"square-0", 1}});
}

TEST_CASE("Coarser maps hide no more light than they may", "[error_bound]") {
  // Radiosity grows by 1 from column to column of 8 texels. Means over 2, 4 and 8 columns differ from it by 1/2, 1 and
  // 2 on average, so the light hidden on a surface of area 1 is that in each band; all light is 3 times the mean, 4.5.
  // Halving by halving, the three squares, of slopes 1, 2 and 4, hide (1/2, 1/2, 1), twice and four times that, of a
  // light of 7 x 4.5 in every band.
  const Scene scene = squares(3);
  const Discretization finest = discretize(scene, {.texels = 8});
  std::vector<glm::dvec3> radiosity;
  for (std::size_t e = 0; e < finest.elements.size(); ++e)
    radiosity.emplace_back((columnOf(finest, e) + 1) * (1 << finest.elements[e].surface));
  const double light = 7 * 4.5;
  using Maps = std::map<std::string, int>;
  const double enough = 1 + 1e-12, tooLittle = 1 - 1e-12;
  CHECK(coarserMaps(scene, finest, 8, 1, radiosity, 0.5 / light * tooLittle) == Maps{});
  CHECK(coarserMaps(scene, finest, 8, 1, radiosity, 0.5 / light * enough) == Maps{{"square-0", 4}});
  CHECK(coarserMaps(scene, finest, 8, 1, radiosity, 1 / light * enough) == Maps{{"square-0", 2}});
  CHECK(coarserMaps(scene, finest, 8, 1, radiosity, 4 / light * enough) == Maps{{"square-0", 1}, {"square-1", 2}});
  CHECK(coarserMaps(scene, finest, 8, 4, radiosity, 14 / light * enough) ==
        Maps{{"square-0", 4}, {"square-1", 4}, {"square-2", 4}});
  CHECK(coarserMaps(scene, finest, 8, 1, radiosity, 14 / light * enough) ==
        Maps{{"square-0", 1}, {"square-1", 1}, {"square-2", 1}});
}

TEST_CASE("The tighter the bound, the greater the effort", "[error_bound]") {
  const Scene scene = squares(2);
  const Discretization finest = discretize(scene, {.texels = 4});
  double before = 0;
  for (const double bound : {0.2, 0.1, 0.05, 0.03, 0.02, 0.015, 0.012, 0.01, 0.008}) {
    CAPTURE(bound);
    const ErrorBoundChoice choice =
        chooseEffort(scene, finest, 4, solutionsThatDiffer(finest.elements.size(), 0.04), bound);
    const double work = choice.effort.patches * choice.effort.resolution / choice.effort.split;
    CHECK(choice.expectedError <= bound);
    CHECK(work >= before);
    before = work;
  }
  CHECK(before > 10 * 2 * 64 / 0.1);
}

TEST_CASE("A bound out of reach is refused, and the one that is named is in reach", "[error_bound]") {
  const Scene scene = squares(2);
  const Discretization finest = discretize(scene, {.texels = 4});
  const SolveWith solutions = solutionsThatDiffer(finest.elements.size(), 0.04);
  std::string message;
  try {
    chooseEffort(scene, finest, 4, solutions, 0.001);
  } catch (const raster::InputError& error) {
    message = error.what();
  }
  const std::string before = "ask for ";
  REQUIRE(message.find(before) != std::string::npos);
  const double reachable = std::stod(message.substr(message.find(before) + before.size()));
  CHECK(reachable > 0.001);
  CHECK_NOTHROW(chooseEffort(scene, finest, 4, solutions, reachable));
  CHECK_THROWS_AS(chooseEffort(scene, finest, 4, solutions, 0.98 * reachable), raster::InputError);
}

TEST_CASE("The true error keeps the bound that was asked for", "[error_bound]") {
  // What chance leaves of the truth (0.35 %) only adds to the error that is measured.
  constexpr int texels = 8;
  for (const std::string name : {"cornell-box", "paper-room", "pyramid-room"}) {
    const Scene scene = loadScene(HEMITEX_DATA "/" + name + ".obj");
    const Discretization finest = discretize(scene, {.texels = texels});
    const TrueRadiosity truth = trueRadiosity(scene, finest, {.samples = 1 << 13});
    REQUIRE(truth.error.fluxWeighted < 0.004);
    for (const double bound : {0.05, 0.02, 0.01}) {
      CAPTURE(name, bound);
      const auto solveWith = [&](const Effort& effort) {
        return solutionOf(scene, settingsFor(texels, effort), effort, residualFor(bound)).radiosity;
      };
      const ErrorBoundChoice choice = chooseEffort(scene, finest, texels, solveWith, bound);
      DiscretizationSettings settings = settingsFor(texels, choice.effort);
      settings.surfaceTexels.insert(choice.surfaceTexels.begin(), choice.surfaceTexels.end());
      const Solution solution = solutionOf(scene, settings, choice.effort, residualFor(bound));
      const auto found = onOtherGrids(discretize(scene, settings), solution.radiosity, finest);
      const double error = errorOf(finest, found, truth.radiosity).fluxWeighted;
      CHECK(error <= bound);
      CHECK(choice.expectedError <= bound);
      CHECK(error > choice.expectedError / 5);  // a bound that costs many times what it has to is none
    }
  }
}
