// The measurement of methods, by methods whose errors are known.
#include "reference/tradeoff/tradeoff.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "radiosity/discretization/discretize.h"
#include "raster/base/parallel.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::reference;
using radiosity::Discretization;
using radiosity::FormFactorRow;
using radiosity::Scene;

namespace {

/// A closed cube with a lamp in its ceiling's place.
Scene litCube() {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.materials.push_back(tests::material("lamp", glm::dvec3(0), glm::dvec3(1, 2, 3)));
  scene.surfaces[3].material = 1;
  return scene;
}

/// The rows that a matrix holds, all of them times `factor`.
TradeMethod rowsOfTruth(const TrueRadiosity& truth, const Discretization& fine, double factor) {
  const auto rows = [&truth, &fine, factor](const Scene&, const Discretization& own, int) -> TradeRows {
    const auto all = std::make_shared<PatchRows>(patchRows(truth.matrix, fine, own));
    const auto rowOf = [all, factor](std::uint32_t patch) {
      FormFactorRow row;
      row.background = radiosity::wholeShare;
      for (std::uint32_t e = 0; e < all->elements; ++e) {
        const double value = factor * all->factors[patch * all->elements + e];
        const auto share = static_cast<std::uint64_t>(std::ldexp(value, radiosity::shareBits));
        if (share == 0) continue;
        row.elements.push_back(e);
        row.shares.push_back(share);
        row.background -= share;
      }
      return row;
    };
    return {std::make_shared<const Discretization>(own), rowOf};
  };
  return {.name = "truth",
          .setting = "none",
          .least = 1,
          .most = 1,
          .measured = {1},
          .directions = [](int) { return 1.0; },
          .bufferBytes = [](int) { return std::size_t{0}; },
          .rows = rows};
}

struct Measured {
  Scene scene = litCube();
  Discretization fine = radiosity::discretize(scene, {.texels = 4});
  TrueRadiosity truth = trueRadiosity(scene, fine, {1 << 10});
};

}  // namespace

TEST_CASE("a method that has the true rows has no error but what its grids cannot show", "[tradeoff]") {
  const Measured measured;
  const std::vector<TradeMethod> methods{rowsOfTruth(measured.truth, measured.fine, 1 - 1e-15)};
  const std::vector<TradeMeasurement> found = measureTradeoff(measured.scene, measured.fine, measured.truth, methods,
                                                              {{0, 1, 4, 1}, {0, 1, 4, 4}, {0, 1, 2, 1}});
  for (const TradeMeasurement& measurement : found) CHECK(measurement.rowError.relativeL1 < 1e-12);
  // With an element a patch it is the algebraic solution, but for the light that was not shot: 1e-4 of what is emitted.
  CHECK(found[0].error.fluxWeighted < 1e-4);
  CHECK(found[0].error.fluxWeighted > 0);
  CHECK(found[1].error.fluxWeighted > 2e-4);
  // A coarse element has the mean of what its four fine ones have.
  CHECK(found[2].error.fluxWeighted > 0.01);
  CHECK(found[2].elements == 24);
  CHECK(found[0].patches == 96);
}

TEST_CASE("rows of half the light are half wrong", "[tradeoff]") {
  const Measured measured;
  const std::vector<TradeMethod> methods{rowsOfTruth(measured.truth, measured.fine, 0.5)};
  const TradeMeasurement found =
      measureTradeoff(measured.scene, measured.fine, measured.truth, methods, {{0, 1, 4, 2}}).front();
  CHECK(found.rowError.relativeL1 == Approx(0.5).epsilon(1e-12));
  // All but the lamp is too dark by half or more. Of the lamp's light L the walls, which reflect half, send more than
  // L/2 and no more than L/2 + L/4 + ... = L: of all light, between half of a third and all of a half is missing.
  CHECK(found.error.fluxWeighted > 1 / 6.0);
  CHECK(found.error.fluxWeighted < 0.5);
}

TEST_CASE("all but times is the same for any number of threads", "[tradeoff]") {
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
    CHECK(one[i].seconds.repetitions.size() == tradeRounds);
  }
}

TEST_CASE("more directions bring every method nearer to the truth", "[tradeoff]") {
  // Elements as large as a fourth of a wall, of an empty cube: each has many of the directions.
  const Measured measured;
  const std::vector<TradeMethod> methods = tradeMethods();
  std::vector<TradeChoice> choices;
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (const int setting : {32, 256}) choices.push_back({m, setting, 2, 1});
  const std::vector<TradeMeasurement> found =
      measureTradeoff(measured.scene, measured.fine, measured.truth, methods, choices);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    INFO(methods[m].name);
    CHECK(found[2 * m + 1].rowError.relativeL1 < found[2 * m].rowError.relativeL1);
  }
}

TEST_CASE("a method may split patches, and its rows are those of the parts", "[tradeoff]") {
  // In a cube whose walls are one patch each, walls are too near to each other.
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

TEST_CASE("choices are all settings on the first grids, and those up to the middle on the others", "[tradeoff]") {
  TradeMethod method = tradeMethods().front();
  method.measured = {32, 64, 128};
  const std::vector<TradeChoice> choices = tradeChoices({method}, {8, 2}, {4, 1});
  // 8 texels have patches of 4 and 1, 2 texels of 1 alone.
  const std::vector<std::array<int, 3>> expected{{32, 8, 4}, {64, 8, 4}, {128, 8, 4}, {32, 8, 1},
                                                 {64, 8, 1}, {32, 2, 1}, {64, 2, 1}};
  REQUIRE(choices.size() == expected.size());
  for (std::size_t i = 0; i < choices.size(); ++i)
    CHECK(std::array{choices[i].setting, choices[i].texels, choices[i].patch} == expected[i]);
}
