// chooseEffort: its choice, and that the choice keeps the bound.
#include "radiosity/solver/error_control.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "data/generate/random_room.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "reference/truth/solution/ground_truth.h"
#include "reference/truth/solution/radiosity_error.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

Discretization twoSquares() {
  Scene scene;
  scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(1)));
  scene.surfaces = {tests::parallelogram("low", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                    tests::parallelogram("high", {0, 0, 1}, {1, 0, 0}, {0, 1, 0})};
  return discretize(tests::finish(std::move(scene)), {.texels = 4});
}

/// Solutions of radiosity 1 with an error that depends on the resolution: every other element gets more, the others
/// less.
SolveWith solutionsWithError(std::size_t elements, double errorTimesResolution) {
  return [=](const Effort& effort) {
    std::vector<glm::dvec3> radiosity(elements, glm::dvec3(1));
    const double error = errorTimesResolution / effort.resolution;
    for (std::size_t e = 0; e < elements; ++e) radiosity[e] *= e % 2 == 0 ? 1 + error : 1 - error;
    return radiosity;
  };
}

std::vector<glm::dvec3> solutionOf(const Scene& scene, const Discretization& discretization, const Effort& effort,
                                   double residual) {
  SceneFormFactors drawn(scene, discretization, layOut(discretization),
                         {.resolution = effort.resolution, .split = effort.split});
  return solve({.scene = scene,
                .discretization = discretization,
                .patches = discretization.patches,
                .rowOf = drawn.rowOf(),
                .split = drawn.splits(),
                .settings = {.residual = residual}})
      .radiosity;
}

/// The random error of the reference only adds to the measured error.
void checkKeepsBounds(const std::string& name, const Scene& scene, int texels) {
  const Discretization discretization = discretize(scene, {.texels = texels});
  const reference::TrueRadiosity truth = reference::trueRadiosity(scene, discretization, {.samples = 1 << 13});
  REQUIRE(truth.error.fluxWeighted < 0.005);
  for (const double bound : {0.05, 0.03, 0.01}) {
    CAPTURE(name, bound);
    std::vector<glm::dvec3> found;
    const auto solveWith = [&](const Effort& effort) {
      return found = solutionOf(scene, discretization, effort, residualFor(bound));
    };
    const ErrorBoundChoice choice = chooseEffort(discretization, {}, solveWith, bound);
    CHECK(choice.expectedErrors->all <= bound);
    CHECK(reference::errorOf(discretization, found, truth.radiosity).fluxWeighted <= bound);
  }
}

}  // namespace

TEST_CASE("chooseEffort takes the first solution whose difference from the one before is within the bound",
          "[error_bound]") {
  // Errors of 1.28 / resolution with equal signs: 0.02 at 64 pixels, 0.01333 at 96, 0.01 at 128. The first two differ
  // by 0.00667, the next two by 0.00333. Over sqrt(2) and 0.75 that is 0.00629 and 0.00314.
  const Discretization discretization = twoSquares();
  const SolveWith solutions = solutionsWithError(discretization.elements.size(), 1.28);
  const ErrorBoundChoice loose = chooseEffort(discretization, {}, solutions, 0.0065);
  CHECK(loose.effort.resolution == 96);
  CHECK(loose.expectedErrors->all == Approx((1.28 / 64 - 1.28 / 96) / std::sqrt(2) / 0.75));
  const ErrorBoundChoice tight = chooseEffort(discretization, {}, solutions, 0.0035);
  CHECK(tight.effort.resolution == 128);
  CHECK(tight.expectedErrors->all == Approx((1.28 / 96 - 1.28 / 128) / std::sqrt(2) / 0.75));
}

TEST_CASE("chooseEffort begins at an effort as fine as the coarsest one that is allowed", "[error_bound]") {
  const Discretization discretization = twoSquares();
  const auto effortsFrom = [&](const Effort& coarsest) {
    std::vector<Effort> efforts;
    const SolveWith equal = [&](const Effort& effort) {
      efforts.push_back(effort);
      return std::vector<glm::dvec3>(discretization.elements.size(), glm::dvec3(1));
    };
    const ErrorBoundChoice choice = chooseEffort(discretization, {}, equal, 0.01, {coarsest});
    REQUIRE(efforts.size() == 2);  // equal solutions differ by nothing
    CHECK(choice.effort.resolution == efforts[1].resolution);
    CHECK(efforts[1].split < efforts[0].split);
    return efforts[0];
  };
  CHECK(effortsFrom({1, 0}).resolution == 64);
  CHECK(effortsFrom({1, 64}).resolution == 64);
  for (const Effort& coarsest : {Effort{1, 66}, {0.04, 0}, {0.002, 128}, {0.01, 512}, {0.0002, 1024}}) {
    const Effort first = effortsFrom(coarsest);
    CAPTURE(coarsest.split, coarsest.resolution, first.split, first.resolution);
    CHECK(first.resolution >= coarsest.resolution);
    CHECK(first.split <= coarsest.split);
    // One of both is reached no earlier.
    CHECK((first.resolution < 2 * coarsest.resolution || first.split > 0.49 * coarsest.split));
  }
  for (const Effort& coarsest : {Effort{1, 1026}, {0.00019, 0}, {1, 4096}})
    CHECK_THROWS_AS(effortsFrom(coarsest), raster::InputError);
}

TEST_CASE("chooseEffort ends with a solution that met a limit, with its error against the one before",
          "[error_bound]") {
  const Discretization discretization = twoSquares();
  const SolveWith solutions = solutionsWithError(discretization.elements.size(), 1.28);
  for (const int last : {1, 2, 3}) {
    int solved = 0;
    const SolveWith counted = [&](const Effort& effort) {
      ++solved;
      return solutions(effort);
    };
    const auto isLast = [&] { return solved == last; };
    const ErrorBoundChoice choice = chooseEffort(discretization, {}, counted, 1e-4, {.isLast = isLast});
    CHECK(solved == last);
    CHECK(choice.effort.resolution == (last == 1 ? 64 : last == 2 ? 96 : 128));
    CHECK(choice.expectedErrors.has_value() == (last > 1));
    if (last == 3) CHECK(choice.expectedErrors->all == Approx((1.28 / 96 - 1.28 / 128) / std::sqrt(2) / 0.75));
  }
}

TEST_CASE("chooseEffort makes more effort for smaller bounds", "[error_bound]") {
  const Discretization discretization = twoSquares();
  double before = 0;
  for (const double bound : {0.1, 0.03, 0.01, 0.003, 0.001, 0.0007}) {
    CAPTURE(bound);
    const ErrorBoundChoice choice =
        chooseEffort(discretization, {}, solutionsWithError(discretization.elements.size(), 2), bound);
    CHECK(choice.expectedErrors->all <= bound);
    CHECK(choice.effort.resolution / choice.effort.split >= before);
    before = choice.effort.resolution / choice.effort.split;
  }
  CHECK(before > 100 * 64 / 0.07);
}

TEST_CASE("lightErrors of all surfaces as seen ones are equal, and one surface has the error of its own flux",
          "[error_bound]") {
  const Discretization discretization = twoSquares();
  std::vector<glm::dvec3> truth(discretization.elements.size(), glm::dvec3(1, 2, 3)), found = truth;
  for (const std::uint32_t e : elementsOf(discretization.grids[0])) found[e] *= e % 2 == 0 ? 1.2 : 0.8;
  for (const std::uint32_t e : elementsOf(discretization.grids[1])) {
    truth[e] *= 4;
    found[e] = truth[e] * 1.1;
  }
  const auto errors = [&](const std::vector<bool>& seen) { return lightErrors(discretization, seen, found, truth); };
  CHECK(errors({true, true}).all == Approx((0.2 + 4 * 0.1) / 5));
  CHECK(errors({true, true}).seen == errors({true, true}).all);
  CHECK(errors({true, false}).seen == Approx(0.2));
  CHECK(errors({false, true}).seen == Approx(0.1));
  for (const std::vector<bool>& seen : {std::vector<bool>{true, false}, {false, true}, {false, false}, {}})
    CHECK(errors(seen).all == errors({true, true}).all);
  for (const std::vector<bool>& unseen : {std::vector<bool>{false, false}, {}}) CHECK(errors(unseen).seen == 0);
  CHECK(errors({true, false}).larger() == Approx(0.2));
  CHECK(errors({false, true}).larger() == Approx((0.2 + 4 * 0.1) / 5));
}

TEST_CASE("chooseEffort keeps the bound of a seen surface that has little of the flux", "[error_bound]") {
  const Discretization discretization = twoSquares();
  // The second square is a thousand times as bright and exact.
  const SolveWith solutions = [&](const Effort& effort) {
    std::vector<glm::dvec3> radiosity = solutionsWithError(discretization.elements.size(), 1.28)(effort);
    for (const std::uint32_t e : elementsOf(discretization.grids[1])) radiosity[e] = glm::dvec3(1000);
    return radiosity;
  };
  const double bound = 0.0035;  // as in the first test
  for (const std::vector<bool>& seen : {std::vector<bool>{}, {false, true}, {true, true}})
    CHECK(chooseEffort(discretization, seen, solutions, bound).effort.resolution == 96);
  const ErrorBoundChoice choice = chooseEffort(discretization, {true, false}, solutions, bound);
  CHECK(choice.effort.resolution == 128);
  CHECK(choice.expectedErrors->seen == Approx((1.28 / 96 - 1.28 / 128) / std::sqrt(2) / 0.75));
  CHECK(choice.expectedErrors->all == Approx(choice.expectedErrors->seen / 1001));
}

TEST_CASE("residualFor leaves a tenth of the bound", "[error_bound]") {
  CHECK(residualFor(0.02) == Approx(0.002));
  CHECK(residualFor(1) == Approx(0.1));
}

// A step that refined only one setting would leave the other error as it is, and D would not bound the sum. The pixels
// of a step cost at most four times those of the step before, which bounds what one step too many costs.
TEST_CASE("chooseEffort refines patches and hemicubes with each effort", "[error_bound]") {
  const Discretization discretization = twoSquares();
  std::vector<Effort> efforts;
  const SolveWith differing = [&](const Effort& effort) {
    efforts.push_back(effort);
    return std::vector<glm::dvec3>(discretization.elements.size(), glm::dvec3(efforts.size() % 2 == 0 ? 1.0 : 2.0));
  };
  CHECK_THROWS_AS(chooseEffort(discretization, {}, differing, 0.1), raster::InputError);
  REQUIRE(efforts.size() > 5);
  for (std::size_t step = 1; step < efforts.size(); ++step) {
    CHECK(efforts[step].split < efforts[step - 1].split);
    CHECK(efforts[step].resolution > efforts[step - 1].resolution);
    CHECK(efforts[step].resolution <= 2 * efforts[step - 1].resolution);
    CHECK(efforts[step].resolution % 2 == 0);
  }
}

TEST_CASE("chooseEffort refuses a bound out of reach, and names one that is in reach", "[error_bound]") {
  const Discretization discretization = twoSquares();
  const SolveWith solutions = solutionsWithError(discretization.elements.size(), 40);
  std::string message;
  try {
    chooseEffort(discretization, {}, solutions, 1e-4);
  } catch (const raster::InputError& error) {
    message = error.what();
  }
  const std::string before = "ask for ";
  REQUIRE(message.find(before) != std::string::npos);
  const double reachable = std::stod(message.substr(message.find(before) + before.size()));
  CHECK(reachable > 1e-4);
  CHECK_NOTHROW(chooseEffort(discretization, {}, solutions, reachable));
  CHECK_THROWS_AS(chooseEffort(discretization, {}, solutions, 0.98 * reachable), raster::InputError);
}

TEST_CASE("chooseEffort returns solutions that keep the bound", "[error_bound]") {
  for (const std::string name : {"cornell-box", "paper-room", "pyramid-room"})
    checkKeepsBounds(name, loadScene(HEMITEX_DATA "/" + name + ".obj"), 8);
}

TEST_CASE("chooseEffort returns solutions that keep the bound in random rooms", "[error_bound]") {
  const TemporaryFolder folder;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const data::Model room = data::randomRoom(seed);
    for (const data::File& file : data::files(room)) std::ofstream(folder.path / file.name) << file.text;
    checkKeepsBounds(room.name, loadScene(folder.path / (room.name + ".obj")), 4);
  }
}
