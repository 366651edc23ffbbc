// Comparison of hemicubes and rays at equal time. Tests check errors, not times.
#include "reference/measurement/bench/equal_time_error.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::reference;
using radiosity::FormFactorRow;
using radiosity::wholeShare;

TEST_CASE("distanceToTruth sums the distances of all values of a row", "[row comparison]") {
  MeasuredRow truth;
  truth.receivers = {{0.25, 0}, {0, 0}, {0.5, 0}, {0.25, 0}};
  CHECK(distanceToTruth({{0, 2, 3}, {wholeShare / 4, wholeShare / 2, wholeShare / 4}}, truth) == 0);
  CHECK(distanceToTruth({{1, 2}, {wholeShare / 2, wholeShare / 2}}, truth) == 1);  // 1/4 + 1/2 + 0 + 1/4
  CHECK(distanceToTruth({{1}, {wholeShare}}, truth) == 2);
  CHECK(distanceToTruth({}, truth) == 1);
}

TEST_CASE("errorAtTime interpolates errors that are a power of time", "[row comparison]") {
  const auto error = [](double seconds) { return 0.01 * std::pow(seconds, -0.75); };
  std::vector<RowQuality> qualities;
  for (const double seconds : {0.001, 0.004, 0.03, 0.5}) qualities.push_back({1, seconds, error(seconds)});
  for (const double seconds : {0.0011, 0.004, 0.01, 0.2, 0.5})
    CHECK(errorAtTime(qualities, seconds).value() == Approx(error(seconds)).epsilon(1e-12));
  CHECK_FALSE(errorAtTime(qualities, 0.0009));
  CHECK_FALSE(errorAtTime(qualities, 0.51));
}

TEST_CASE("spreadPatches spreads its patches over all patches", "[row comparison]") {
  const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const auto discretization = radiosity::discretize(scene, {.texels = 4, .patch = 2});  // 24 patches
  const auto numbers = [&](std::size_t count) {
    std::vector<std::uint32_t> found;
    for (const radiosity::Patch& patch : spreadPatches(discretization, count)) found.push_back(patch.number);
    return found;
  };
  CHECK(numbers(6) == std::vector<std::uint32_t>{2, 6, 10, 14, 18, 22});
  CHECK(numbers(1) == std::vector<std::uint32_t>{12});
  CHECK(spreadPatches(discretization, 100).size() == 24);
}

TEST_CASE("compareRows gives the same errors in each run, smaller ones for more pixels or rays", "[row comparison]") {
  const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const auto discretization = radiosity::discretize(scene, {.texels = 4, .patch = 2});
  const RowComparisonSettings settings{.hemicubes = {32, 128},
                                       .turnedHemicubes = {128},
                                       .rays = {64, 1 << 12, 1 << 16},
                                       .points = 6,
                                       .truthSamples = 64,
                                       .repeats = 1};
  const RowComparison first = compareRows(scene, discretization, settings),
                      second = compareRows(scene, discretization, settings);
  CHECK(first.patches.size() == 6);
  CHECK(first.truthError < 1e-12);  // without blockers true rows are closed forms
  REQUIRE(first.hemicubes.size() == 2);
  REQUIRE(first.rays.size() == 3);
  REQUIRE(first.turnedHemicubes.size() == 1);
  for (const auto& [a, b] : {std::pair{first.hemicubes, second.hemicubes},
                             {first.turnedHemicubes, second.turnedHemicubes},
                             {first.rays, second.rays}})
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(a[i].size == b[i].size);
      CHECK(a[i].error == b[i].error);
      CHECK(a[i].seconds > 0);
    }
  // Without rotation, the pixels along an outline of an element are wrong together.
  CHECK(first.turnedHemicubes[0].error < first.hemicubes[1].error);
  // Errors fall with the number of pixels along a side. With rays they fall faster than the root of their number.
  CHECK(first.hemicubes[1].error < first.hemicubes[0].error / 3);
  CHECK(first.rays[1].error < first.rays[0].error / 8);
  CHECK(first.rays[2].error < first.rays[1].error / 4);
}
