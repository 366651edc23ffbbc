// solve: the furnace, the account of flux, and independence of threads and memory.
#include "radiosity/solver/progressive_solver.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/solver/loss_warning.h"
#include "raster/base/parallel.h"
#include "raster/software/software_renderer.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "tests/support/box_scene.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

struct Run {
  Scene scene;
  Discretization discretization;
  Solution solution;
};

Run run(Scene scene, int texels, int patch, int resolution, const SolverSettings& settings) {
  Run result{std::move(scene), {}, {}};
  result.discretization = discretize(result.scene, {.texels = texels, .patch = patch});
  const IdLayout layout = layOut(result.discretization);
  raster::SoftwareRenderer renderer(makeDrawList(result.scene, result.discretization, layout));
  ProjectedFormFactors rows(result.scene, result.discretization, layout, renderer, {.resolution = resolution});
  result.solution = solve({.scene = result.scene,
                           .discretization = result.discretization,
                           .patches = result.discretization.patches,
                           .rowOf = [&](const Patch& from) { return rows.ofPatch(from); },
                           .settings = settings});
  return result;
}

/// The area-weighted mean of a band, and the largest relative deviation of an element from it.
struct Spread {
  double mean, largest;
};
Spread spreadOf(const Run& run) {
  double area = 0, flux = 0;
  for (std::size_t e = 0; e < run.discretization.elements.size(); ++e) {
    area += run.discretization.elements[e].area;
    flux += run.discretization.elements[e].area * run.solution.radiosity[e].x;
  }
  Spread spread{flux / area, 0};
  for (const glm::dvec3& b : run.solution.radiosity)
    spread.largest = std::max(spread.largest, std::abs(b.x / spread.mean - 1));
  return spread;
}

void checkAccount(const Energy& energy) {
  for (std::size_t band = 0; band < 3; ++band) {
    const double accounted = energy.absorbed[band] + energy.unshot[band] + energy.lost[band];
    CHECK(std::abs(accounted - energy.emitted[band]) <= 1e-12 * energy.emitted[band]);
  }
}

/// An open box with colours, a light and two blockers: flux is absorbed, leaves, and is lost to a back.
Scene openBox() {
  Scene scene = tests::closedCube({0.7, 0.5, 0.2}, glm::dvec3(0));
  scene.materials.push_back(tests::material("light", glm::dvec3(0.1), {3, 2, 1}));
  scene.surfaces.erase(scene.surfaces.begin() + 3);
  scene.surfaces.push_back(
      tests::quad("light", {{{0.3, 0.9, 0.3}, {0.6, 0.9, 0.3}, {0.6, 0.9, 0.7}, {0.3, 0.9, 0.7}}}, 1));
  scene.surfaces.push_back(
      tests::quad("blocker", {{{0.1, 0.4, 0.1}, {0.1, 0.4, 0.5}, {0.6, 0.4, 0.5}, {0.6, 0.4, 0.1}}}));
  scene.surfaces.push_back(
      tests::quad("turned", {{{0.5, 0.3, 0.5}, {0.9, 0.3, 0.5}, {0.9, 0.3, 0.9}, {0.5, 0.3, 0.9}}}));
  return tests::finish(scene);
}

}  // namespace

TEST_CASE("solve of a closed furnace gives a mean radiosity of E / (1 - r) within the residual", "[solver]") {
  // Flux is conserved: emitted = absorbed + unshot, and absorbed = (1 - r) of the received flux. With E = 1 everywhere
  // the mean of B is therefore exactly (1 - r * residual) / (1 - r), for any form factors.
  for (const double r : {0.0, 0.5, 0.9, 0.99}) {
    INFO("reflectance " << r);
    const Run furnace = run(tests::closedCube(glm::dvec3(r), glm::dvec3(1)), 4, 2, 32, {.residual = 0.001});
    const double residual = furnace.solution.residual;
    CHECK(residual <= 0.001);
    CHECK(spreadOf(furnace).mean == Approx((1 - r * residual) / (1 - r)).epsilon(1e-11));
    checkAccount(furnace.solution.energy);
    CHECK(areZero(furnace.solution.energy.lost));
  }
}

TEST_CASE("solve of a furnace gives a smaller spread over elements with finer patches", "[solver]") {
  // With one centre per patch, the elements opposite to it receive too much. The same 8 x 8 elements per face, with
  // patches of 8, 4, 2 and 1 elements along a side.
  std::vector<double> spreads;
  for (const int patch : {8, 4, 2, 1})
    spreads.push_back(spreadOf(run(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, patch, 128, {})).largest);
  for (std::size_t i = 1; i < spreads.size(); ++i) CHECK(spreads[i] < spreads[i - 1]);
}

// With one patch per face all six patches send out the same flux, 1 / (1 - 0.5) per area. An element e then has the
// radiosity 1 + 0.5 * 2 * sum over the other faces of F(centre of the face, e) / A_e, with form factors in closed form.
// The dimmest elements, in the corners, cover about 150 of the 256 x 256 pixels of a view, of which 50 lie on their
// borders. Each of these is wrong by up to half a pixel: sqrt(50) / sqrt(12) / 150 = 1.4 % of the light from one face,
// and 0.6 % of that from five. Twice that is the limit.
TEST_CASE("solve of a furnace with one patch per face has the radiosity of the closed forms", "[solver]") {
  const Run furnace = run(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 8, 256, {.residual = 1e-9});
  double largest = 0;
  for (std::uint32_t e = 0; e < furnace.discretization.elements.size(); ++e) {
    const std::uint32_t surface = furnace.discretization.elements[e].surface;
    const auto& [a, b, c] = furnace.scene.surfaces[surface].triangles.front().position;
    const glm::dvec3 middle = elementCentre(furnace.scene, furnace.discretization, e).position;
    const glm::dvec3 u = (b - a) / 16.0, v = (c - b) / 16.0;  // half the sides of an element
    const std::vector<glm::dvec3> corners{middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    double arriving = 0;
    for (const Patch& patch : furnace.discretization.patches.list) {
      if (patch.surface == surface) continue;
      const SurfacePoint centre = patchCentre(furnace.scene, furnace.discretization, patch);
      arriving += reference::pointToPolygon(centre.position, centre.normal, corners);
    }
    const double expected = 1 + arriving / furnace.discretization.elements[e].area;
    largest = std::max(largest, std::abs(furnace.solution.radiosity[e].x / expected - 1));
  }
  CHECK(largest < 2 * 0.006);
}

TEST_CASE("solve accounts for all flux after any number of shots in an open scene", "[solver]") {
  for (const int shots : {0, 1, 2, 10, 100}) {
    INFO(shots << " shots");
    const Run open = run(openBox(), 8, 4, 64, {.residual = 0, .shots = shots});
    CHECK(open.solution.shots == shots);
    checkAccount(open.solution.energy);
    if (shots > 0) CHECK(open.solution.energy.lost[0] > 0);
    CHECK(open.solution.energy.lostToBacks[0] <= open.solution.energy.lost[0]);
  }
}

TEST_CASE("solve warns if more than one percent is lost to backs", "[solver]") {
  const Run open = run(openBox(), 8, 4, 64, {});
  REQUIRE(open.solution.warnings.size() == 1);
  const Energy& energy = open.solution.energy;
  char share[16];
  std::snprintf(share, sizeof share, "%.1f %% ", 100 * bandSum(energy.lostToBacks) / bandSum(energy.emitted));
  CHECK_THAT(open.solution.warnings[0].text, Catch::StartsWith(share) && Catch::Contains("backs of faces"));
  CHECK(open.solution.warnings[0].isAboutBacks);
  CHECK(run(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 4, 2, 32, {}).solution.warnings.empty());
}

TEST_CASE("solve warns if nearly all light leaves the scene", "[solver]") {
  // A light that faces away from all else.
  Scene scene = openBox();
  for (Surface& surface : scene.surfaces)
    if (surface.name == "light") surface = tests::quad("light", {{{0, 9, 0}, {0, 9, 1}, {1, 9, 1}, {1, 9, 0}}}, 1);
  const Run dark = run(tests::finish(scene), 4, 2, 32, {});
  const auto warning = lossWarning(dark.scene, dark.solution.energy);
  REQUIRE(warning);
  REQUIRE(dark.solution.warnings.size() == 1);
  CHECK(dark.solution.warnings[0].text == *warning);
  CHECK(!dark.solution.warnings[0].isAboutBacks);
}

TEST_CASE("solve lists likely shots whose rows are not in the cache", "[solver]") {
  const Scene scene = openBox();
  const Discretization discretization = discretize(scene, {.texels = 8, .patch = 4});
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 32});
  std::vector<std::uint32_t> shot, foremost;
  const auto rowOf = [&](const Patch& patch) {
    shot.push_back(patch.number);
    return rows.ofPatch(patch);
  };
  // The cache keeps all rows, so that a patch whose row is computed was the first of a list, after the first shot.
  const auto look = [&](const NextShots& next) {
    const std::vector<LikelyShot> likely = next.likely(discretization.patches.list.size());
    for (const LikelyShot& each : likely) CHECK(std::count(shot.begin(), shot.end(), each.patch) == 0);
    if (!likely.empty()) foremost.push_back(likely.front().patch);
  };
  solve({.scene = scene,
         .discretization = discretization,
         .patches = discretization.patches,
         .rowOf = rowOf,
         .prepare = look,
         .settings = {.residual = 0, .shots = 30}});
  CHECK(shot.size() > 4);
  for (std::size_t i = 1; i < shot.size(); ++i) CHECK(std::count(foremost.begin(), foremost.end(), shot[i]) > 0);
}

TEST_CASE("solve goes on until light has come to what is seen", "[solver]") {
  // Each square sees its neighbours in a row: a fiftieth of the light goes one step, and a lamp lights the first.
  constexpr std::uint32_t count = 4;
  std::vector<Surface> squares;
  for (std::uint32_t s = 0; s < count; ++s)
    squares.push_back(tests::parallelogram("square" + std::to_string(s), {2.0 * s, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  Scene scene = tests::sceneOf(std::move(squares));
  scene.materials.resize(2);
  scene.materials[0].reflectance = glm::dvec3(0.5);
  scene.materials[1].emission = glm::dvec3(1);
  scene.surfaces[0].material = 1;
  const Discretization discretization = discretize(scene, {.texels = 1});
  const auto rowOf = [](const Patch& patch) {
    FormFactorRow row;
    row.background = wholeShare;
    for (std::uint32_t other = 0; other < count; ++other)
      if (other + 1 == patch.surface || other == patch.surface + 1) {
        row.elements.push_back(other);
        row.shares.push_back(wholeShare / 50);
        row.background -= row.shares.back();
      }
    return row;
  };
  const auto lastOf = [&](double residual, const SeenLight& seen) {
    return solve({.scene = scene,
                  .discretization = discretization,
                  .patches = discretization.patches,
                  .rowOf = rowOf,
                  .settings = {.residual = residual},
                  .seen = seen})
        .radiosity.back()
        .x;
  };
  const double right = lastOf(0, {});
  CHECK(right == Approx(std::pow(0.01, count - 1)).epsilon(0.01));  // light that returns adds little
  CHECK(lastOf(0.001, {}) == 0);
  CHECK(lastOf(0.001, {{false, false, false, true}}) == Approx(right).epsilon(0.02));
  CHECK(lastOf(0.001, {{false, false, false, false}}) == 0);
}

TEST_CASE("solve gives the same bits for any number of threads and any row cache", "[solver]") {
  const auto solveWith = [](int threads, std::size_t cache) {
    const raster::ThreadLimit limit(threads);
    return run(openBox(), 8, 4, 64, {.residual = 0.01, .rowCacheBytes = cache}).solution;
  };
  const Solution reference = solveWith(1, std::size_t{1} << 30);
  for (const int threads : {1, 2, 7})
    for (const std::size_t cache : {std::size_t{0}, std::size_t{20000}, std::size_t{1} << 30}) {
      const Solution solution = solveWith(threads, cache);
      CHECK(solution.radiosity == reference.radiosity);
      CHECK(solution.shots == reference.shots);
      CHECK(solution.residual == reference.residual);
    }
}

TEST_CASE("solve gives an ambient estimate equal to the rest of a furnace's radiosity", "[solver]") {
  // In a furnace of reflectance r the mean radiosity so far is (1 - r * residual) / (1 - r). The rest of 1 / (1 - r) is
  // r * residual / (1 - r), which is r times the ambient radiosity.
  const double r = 0.8;
  const Run furnace = run(tests::closedCube(glm::dvec3(r), glm::dvec3(1)), 4, 2, 32, {.residual = 0, .shots = 12});
  CHECK(furnace.solution.residual > 0.1);
  CHECK(spreadOf(furnace).mean + r * furnace.solution.ambient.x == Approx(1 / (1 - r)).epsilon(1e-12));
}

TEST_CASE("solve and refine shoot until the seen surfaces have the residual, too", "[solver]") {
  // A bright closed room, and a seen one whose lamps emit a millionth of its light.
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  scene.materials.push_back(tests::material("faint", glm::dvec3(0.5), glm::dvec3(1e-6)));
  for (Surface surface : tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)).surfaces) {
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& corner : triangle.position) corner.x += 2;
    surface.name = surface.family = surface.name + "-seen";
    surface.material = 1;
    scene.surfaces.push_back(surface);
  }
  scene = tests::finish(std::move(scene));
  const Discretization discretization = discretize(scene, {.texels = 2, .patch = 2});
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 32});
  constexpr double residual = 0.01;
  std::vector<bool> seen(scene.surfaces.size());
  for (std::size_t s = 6; s < seen.size(); ++s) seen[s] = true;
  const auto inputFor = [&](const std::vector<bool>& surfaces) {
    return SolveInput{.scene = scene,
                      .discretization = discretization,
                      .patches = discretization.patches,
                      .rowOf = [&](const Patch& from) { return rows.ofPatch(from); },
                      .settings = {.residual = residual},
                      .seen = {surfaces, {}, residual},
                      .isContinued = true};
  };
  const auto seenResidual = [&](const Solution& solution) {
    ShootingState state(scene, discretization, discretization.patches, solution.continuation->light);
    state.setSeen(seen);
    return state.seenResidual();
  };
  CHECK(seenResidual(solve(inputFor(seen))) <= residual);
  Solution unseen = solve(inputFor({}));
  REQUIRE(seenResidual(unseen) > residual);
  CHECK(seenResidual(refine(inputFor(seen), std::move(*unseen.continuation))) <= residual);
}
