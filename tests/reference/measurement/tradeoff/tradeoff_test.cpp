// The measurement of methods, tested with methods of known errors.
#include "reference/measurement/tradeoff/tradeoff.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "raster/base/parallel.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::reference;
using radiosity::Discretization;
using radiosity::FormFactorRow;
using radiosity::Scene;

namespace {

/// A closed cube whose ceiling is a lamp.
Scene litCube() {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.materials.push_back(tests::material("lamp", glm::dvec3(0), glm::dvec3(1, 2, 3)));
  scene.surfaces[3].material = 1;
  return scene;
}

/// A method whose rows are those of the true matrix, times `factor`.
TradeMethod rowsOfTruth(const TrueRadiosity& truth, const Discretization& fine, double factor) {
  const auto others = [&truth, &fine, factor](const radiosity::PatchRows&, const Scene&, const Discretization& own) {
    const auto all = std::make_shared<DenseRows>(denseRows(truth.matrix, fine, own));
    const auto rowOf = [all, factor](const radiosity::Patch& patch) {
      FormFactorRow row;
      row.background = radiosity::wholeShare;
      for (std::uint32_t e = 0; e < all->elements; ++e) {
        const double value = factor * all->factors[patch.number * all->elements + e];
        const auto share = static_cast<std::uint64_t>(std::ldexp(value, radiosity::shareBits));
        if (share == 0) continue;
        row.elements.push_back(e);
        row.shares.push_back(share);
        row.background -= share;
      }
      return row;
    };
    return radiosity::PatchRows{rowOf};
  };
  return {.name = "truth",
          .setting = "none",
          .smallest = 1,
          .largest = 1,
          .measured = {1},
          .directions = [](int) { return 1.0; },
          .bufferBytes = [](int) { return std::size_t{0}; },
          .rows = [others](int) { return TradeRows{.drawing = {.split = 1}, .others = others}; }};
}

struct Measured {
  Scene scene = litCube();
  Discretization fine = radiosity::discretize(scene, {.texels = 4});
  TrueRadiosity truth = trueRadiosity(scene, fine, {1 << 13});
};

/// The Pareto front by a search in the order of ascending time: a choice is on it if its error is below those of all
/// choices before it.
std::vector<bool> frontByOrder(const std::vector<TradeMeasurement>& measurements) {
  const auto choice = [&](std::size_t i) {
    return std::pair{measurements[i].seconds.median, measurements[i].error.fluxWeighted};
  };
  std::vector<std::size_t> order(measurements.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return choice(a) < choice(b); });
  std::vector<bool> isOnFront(measurements.size());
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equalsLast = i > 0 && choice(order[i]) == choice(order[i - 1]);
    isOnFront[order[i]] = equalsLast ? isOnFront[order[i - 1]] : choice(order[i]).second < smallest;
    smallest = std::min(smallest, choice(order[i]).second);
  }
  return isOnFront;
}

}  // namespace

TEST_CASE("markFront agrees with a search in the order of time, also for ties and equal choices", "[tradeoff]") {
  std::mt19937 random(1);
  for (const unsigned values : {2U, 5U, 1000U})
    for (std::size_t size = 0; size < 40; ++size) {
      std::vector<TradeMeasurement> measurements(size);
      for (TradeMeasurement& measurement : measurements) {
        measurement.seconds.median = static_cast<double>(random() % values);
        measurement.error.fluxWeighted = static_cast<double>(random() % values);
      }
      markFront(measurements);
      std::vector<bool> isOnFront;
      for (const TradeMeasurement& measurement : measurements) isOnFront.push_back(measurement.isOnFront);
      CHECK(isOnFront == frontByOrder(measurements));
    }
}

TEST_CASE("measureTradeoff finds only the error of the grids for a method with the true rows", "[tradeoff]") {
  const Measured measured;
  const std::vector<TradeMethod> methods{rowsOfTruth(measured.truth, measured.fine, 1 - 1e-15)};
  const std::vector<TradeMeasurement> found = measureTradeoff(measured.scene, measured.fine, measured.truth, methods,
                                                              {{0, 1, 4, 1}, {0, 1, 4, 4}, {0, 1, 2, 1}});
  for (const TradeMeasurement& measurement : found) CHECK(measurement.rowError.relativeL1 < 1e-12);
  // With one element per patch the only error is the unshot light, 1e-4 of the emitted flux.
  CHECK(found[0].error.fluxWeighted < 1e-4);
  CHECK(found[0].error.fluxWeighted > 0);
  CHECK(found[1].error.fluxWeighted > 2e-4);
  // A coarse element has the mean radiosity of its four fine elements.
  CHECK(found[2].error.fluxWeighted > 0.01);
  CHECK(found[2].elements == 24);
  CHECK(found[0].patches == 96);
}

TEST_CASE("measureTradeoff finds a relative row error of 1/2 for rows with half of the light", "[tradeoff]") {
  const Measured measured;
  const std::vector<TradeMethod> methods{rowsOfTruth(measured.truth, measured.fine, 0.5)};
  const TradeMeasurement found =
      measureTradeoff(measured.scene, measured.fine, measured.truth, methods, {{0, 1, 4, 2}}).front();
  CHECK(found.rowError.relativeL1 == Approx(0.5).epsilon(1e-12));
  // All surfaces except the lamp are too dark by half or more. The walls reflect half of their light. For flux L of the
  // lamp they send between L/2 and L/2 + L/4 + ... = L. So between 1/6 and 1/2 of all light is missing.
  CHECK(found.error.fluxWeighted > 1 / 6.0);
  CHECK(found.error.fluxWeighted < 0.5);
}

TEST_CASE("measureTradeoff gives the same results, except times, for any number of threads", "[tradeoff]") {
  const Measured measured;
  const std::vector<TradeMethod> methods = tradeMethods();
  std::vector<TradeChoice> choices;
  for (std::size_t m = 0; m < methods.size(); ++m) choices.push_back({m, 64, 2, 1});
  const auto measure = [&](int threads) {
    const raster::ThreadLimit limit(threads);
    return measureTradeoff(measured.scene, measured.fine, measured.truth, methods, choices);
  };
  const std::vector<TradeMeasurement> one = measure(1), three = measure(3);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    CHECK(one[i].radiosity == three[i].radiosity);
    CHECK(one[i].rowError.relativeL1 == three[i].rowError.relativeL1);
    CHECK(one[i].rowBytes == three[i].rowBytes);
    REQUIRE_FALSE(one[i].seconds.repetitions.empty());
    CHECK(one[i].seconds.repetitions.size() == (one[i].seconds.repetitions.front() > longTime ? 1 : tradeRounds));
  }
}

TEST_CASE("tradeMethods have smaller row errors with more directions", "[tradeoff]") {
  // An empty cube with four elements per wall, so that each element has many directions. Of aligned hemicubes, the
  // error of the centre is so much larger than that of pixels that 32 pixels have 0.3 % less than 256, with 2^15 rays
  // per element for the truth.
  const Measured measured;
  const std::vector<TradeMethod> methods = tradeMethods();
  std::vector<TradeChoice> choices;
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (const int setting : {32, 256}) choices.push_back({m, setting, 2, 1});
  const std::vector<TradeMeasurement> found =
      measureTradeoff(measured.scene, measured.fine, measured.truth, methods, choices);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    INFO(methods[m].name);
    const double margin = methods[m].name == "hemicube" ? 1.01 : 1;
    CHECK(found[2 * m + 1].rowError.relativeL1 < margin * found[2 * m].rowError.relativeL1);
  }
}

TEST_CASE("measureTradeoff measures the rows of split patches for split-hemicube", "[tradeoff]") {
  // In a cube with one patch per wall, patches are too near to their receivers.
  const Measured measured;
  std::vector<TradeMethod> methods = tradeMethods();
  std::erase_if(methods, [](const TradeMethod& method) { return method.name.find("hemicube") == std::string::npos; });
  REQUIRE(methods.size() == 3);
  const std::vector<TradeMeasurement> found = measureTradeoff(measured.scene, measured.fine, measured.truth, methods,
                                                              {{0, 128, 4, 4}, {1, 128, 4, 4}, {2, 128, 4, 4}});
  CHECK(found[0].patches == 6);
  CHECK(found[1].patches == 6);
  CHECK(found[2].patches > 6);
  CHECK(found[2].elements == 96);
  CHECK(found[2].error.fluxWeighted < found[0].error.fluxWeighted / 2);
}

TEST_CASE("tradeChoices has all settings on the first grid, and those up to the middle on the others", "[tradeoff]") {
  TradeMethod method = tradeMethods().front();
  method.measured = {32, 64, 128};
  const std::vector<TradeChoice> choices = tradeChoices({method}, {8, 2}, {4, 1});
  // Grids of 8 texels have patches of 4 and of 1; grids of 2 texels have patches of 1 only.
  const std::vector<std::array<int, 3>> expected{{32, 8, 4}, {64, 8, 4}, {128, 8, 4}, {32, 8, 1},
                                                 {64, 8, 1}, {32, 2, 1}, {64, 2, 1}};
  REQUIRE(choices.size() == expected.size());
  for (std::size_t i = 0; i < choices.size(); ++i)
    CHECK(std::array{choices[i].setting, choices[i].texels, choices[i].patch} == expected[i]);
}
