#include "radiosity/bands/shared_rows.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "radiosity/bands/colour_solution.h"
#include "radiosity/bands/spectral_scene.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "raster/base/parallel.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A furnace, or a lamp in a coloured box, with spectra of its materials.
struct Box {
  Scene scene;
  SpectralBands bands;
};

const std::vector<double> wavelengths{400, 440, 480, 520, 560, 600, 640};

Box furnace() {
  return {tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)),
          {wavelengths,
           {{"grey", {{{wavelengths, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}}}, {{wavelengths, {7, 6, 5, 4, 3, 2, 1}}}}}}}};
}

Box litBox() {
  Box box{tests::closedCube(glm::dvec3(0.5), glm::dvec3(0)), {wavelengths, {}}};
  box.scene.materials.push_back(tests::material("lamp", glm::dvec3(0.1), glm::dvec3(1)));
  box.scene.surfaces.push_back(
      tests::quad("lamp", {{{0.3, 0.9, 0.3}, {0.6, 0.9, 0.3}, {0.6, 0.9, 0.7}, {0.3, 0.9, 0.7}}}, 1));
  box.scene = tests::finish(std::move(box.scene));
  box.bands.materials["grey"].reflectance = {wavelengths, {0.3, 0.7, 0.5, 0.2, 0.8, 0.6, 0.4}};
  box.bands.materials["lamp"].emission = {wavelengths, {1, 2, 3, 5, 8, 13, 21}};
  return box;
}

struct Solved {
  Discretization discretization;  ///< with the patches after all solutions
  std::vector<Solution> solutions;
  int rows = 0;  ///< number of computed rows
};

/// Solves the groups one after another.
Solved solved(const Box& box, const std::vector<BandGroup>& groups, const DrawingSettings& drawing,
              const SolverSettings& settings = {}) {
  Scene scene = box.scene;
  Solved result{discretize(scene, {.texels = 6, .patch = 3}), {}};
  SceneFormFactors drawn(scene, result.discretization, layOut(result.discretization), drawing);
  const auto inputOf = [&](std::size_t number) {
    scene.materials = inGroup(box.scene, box.bands, groups[number]).materials;
    return SolveInput{.scene = scene,
                      .discretization = result.discretization,
                      .patches = {},
                      .rowOf =
                          [&, rowOf = drawn.rowOf()](const Patch& patch) {
                            ++result.rows;
                            return rowOf(patch);
                          },
                      .split = drawn.splits(),
                      .settings = settings};
  };
  result.solutions = solveWithSameRows(groups.size(), result.discretization.patches, inputOf);
  result.discretization.patches = std::move(result.solutions.back().patches);
  return result;
}

}  // namespace

TEST_CASE("solveWithSameRows of a furnace gives a mean radiosity of E / (1 - r) in each of seven bands", "[bands]") {
  const Box box = furnace();
  Solved run = solved(box, groupsOfBands(7), {.resolution = 64}, {.residual = 1e-6});
  const BandSolution solution{wavelengths, std::move(run.solutions)};
  for (std::size_t band = 0; band < 7; ++band) {
    double flux = 0, area = 0;
    for (std::size_t e = 0; e < run.discretization.elements.size(); ++e) {
      flux += run.discretization.elements[e].area * radiosityIn(solution, band, e);
      area += run.discretization.elements[e].area;
    }
    const MaterialSpectra& grey = box.bands.materials.at("grey");
    const double truth = grey.emission->values[band] / (1 - grey.reflectance->values[band]);
    CHECK(flux / area == Approx(truth).epsilon(1e-5));
  }
}

TEST_CASE("solveWithSameRows has the bits of solve for the first group, with the same patches", "[bands]") {
  const Box box = litBox();
  const std::vector<BandGroup> groups = groupsOfBands(7);
  for (const double split : {1.0, 0.003}) {
    const DrawingSettings drawing{.resolution = 32, .split = split};
    const Solved together = solved(box, groups, drawing), alone = solved(box, {groups[0]}, drawing);
    CHECK(together.solutions[0].radiosity == alone.solutions[0].radiosity);
    CHECK(together.solutions[0].shots == alone.solutions[0].shots);
  }
}

// Two solutions of the same patches and rows differ in absorbed flux by at most the sum of their residuals, which are
// shares of the emitted flux (shooting_state.h).
TEST_CASE("solveWithSameRows absorbs in each group what it absorbs alone, within the sum of the residuals", "[bands]") {
  const Box box = litBox();
  const std::vector<BandGroup> groups = groupsOfBands(7);
  const DrawingSettings unsplit{.resolution = 32, .split = 1};
  for (const double residual : {0.1, 0.001, 1e-7}) {
    const Solved together = solved(box, groups, unsplit, {.residual = residual, .keepsIrradiance = true});
    int rowsAlone = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Solved alone = solved(box, {groups[g]}, unsplit, {.residual = residual, .keepsIrradiance = true});
      rowsAlone += alone.rows;
      const Scene scene = inGroup(box.scene, box.bands, groups[g]);
      const Solution &a = together.solutions[g], &b = alone.solutions[0];
      double difference = 0;
      for (std::uint32_t e = 0; e < together.discretization.elements.size(); ++e)
        difference +=
            together.discretization.elements[e].area * bandSum((1.0 - reflectance(scene, together.discretization, e)) *
                                                               glm::abs(a.irradiance[e] - b.irradiance[e]));
      CHECK(difference <= (a.residual + b.residual) * bandSum(a.energy.emitted) * (1 + 1e-9));
      CHECK(a.residual <= residual);
      if (g > 0) CHECK(a.shots < b.shots);
    }
    CHECK(together.rows < rowsAlone);
    CHECK(together.rows <= static_cast<int>(together.discretization.patches.list.size()));
  }
}

TEST_CASE("solveWithSameRows goes on from groups without light", "[bands]") {
  Box box = litBox();
  box.bands.materials["lamp"].emission = {wavelengths, {1, 2, 3, 5, 0, 0, 0}};
  const DrawingSettings unsplit{.resolution = 32, .split = 1};
  Solved together = solved(box, groupsOfBands(7), unsplit);
  CHECK(together.solutions[0].shots == 0);
  CHECK(together.solutions[0].radiosity[0] == glm::dvec3(0));
  const Solved alone = solved(box, {groupsOfBands(7)[1]}, unsplit);
  CHECK(together.solutions[1].radiosity == alone.solutions[0].radiosity);
}

// The order of shots depends on all bands of a group, and ends at a residual. So a band alone differs by at most the
// sum of both residuals, as a share of the emitted flux.
TEST_CASE("solveWithSameRows gives each of seven bands what it has alone, within the residuals", "[bands]") {
  const Box box = litBox();
  const DrawingSettings unsplit{.resolution = 32, .split = 1};
  const SolverSettings settings{.residual = 1e-9};
  Solved together = solved(box, groupsOfBands(7), unsplit, settings);
  const BandSolution solution{wavelengths, std::move(together.solutions)};
  for (std::size_t band = 0; band < 7; ++band) {
    const Solved alone = solved(box, {BandGroup{std::vector{band}, {}, {}}}, unsplit, settings);
    for (std::size_t e = 0; e < together.discretization.elements.size(); ++e)
      CHECK(radiosityIn(solution, band, e) == Approx(alone.solutions[0].radiosity[e].x).epsilon(1e-6));
  }
}

TEST_CASE("solveWithSameRows splits patches once, and accounts for all flux of each group", "[bands]") {
  const Box box = litBox();
  std::vector<BandGroup> groups = groupsOfBands(7);
  groups.insert(groups.begin(), wholeSpectrum(wavelengths));
  const Solved run = solved(box, groups, {.resolution = 64});
  CHECK(run.discretization.patches.list.size() > 7 * 4);
  CHECK(run.rows <= static_cast<int>(run.discretization.patches.list.size()));
  for (const Solution& solution : run.solutions) {
    CHECK(solution.residual <= 0.001);
    for (int place = 0; place < 3; ++place) {
      const Energy& energy = solution.energy;
      CHECK(energy.absorbed[place] + energy.unshot[place] + energy.lost[place] ==
            Approx(energy.emitted[place]).epsilon(1e-12).margin(1e-300));
    }
  }
}

TEST_CASE("solveWithSameRows gives the same bits for any number of threads and any row cache", "[bands]") {
  const Box box = litBox();
  const std::vector<BandGroup> groups = groupsOfBands(7);
  const auto radiosityOf = [&](const SolverSettings& settings) {
    std::vector<std::vector<glm::dvec3>> found;
    for (const Solution& solution : solved(box, groups, {.resolution = 32}, settings).solutions)
      found.push_back(solution.radiosity);
    return found;
  };
  const auto expected = radiosityOf({});
  CHECK(radiosityOf({.rowCacheBytes = 0}) == expected);
  const raster::ThreadLimit limit(1);
  CHECK(radiosityOf({}) == expected);
}

TEST_CASE("solveWithSameRows ends each solution after one shot once the progress asked to end", "[bands]") {
  const Box box = litBox();
  Scene scene = box.scene;
  const Discretization discretization = discretize(scene, {.texels = 6, .patch = 3});
  SceneFormFactors drawn(scene, discretization, layOut(discretization), {.resolution = 32, .split = 1});
  const auto inputOf = [&](std::size_t) {
    return SolveInput{.scene = scene, .discretization = discretization, .patches = {}, .rowOf = drawn.rowOf()};
  };
  int calls = 0;
  const std::vector<Solution> solutions =
      solveWithSameRows(3, discretization.patches, inputOf, [&](const Step&) { return ++calls < 3; });
  CHECK(solutions[0].shots == 3);
  CHECK(solutions[1].shots == 1);  // after the guess
  CHECK(solutions[2].shots == 1);
  for (const Solution& solution : solutions) CHECK(solution.isInterrupted);
}
