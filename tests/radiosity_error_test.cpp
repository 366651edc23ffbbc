// The error measures of a solution, on numbers that can be checked by hand.
#include "reference/radiosity_error.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace hemitex;

namespace {

/// Two surfaces: elements of areas 1 and 3, and one of area 4.
radiosity::Discretization threeElements() {
  radiosity::Discretization discretization;
  discretization.elements = {{1, 0, 0, 0, 0}, {3, 0, 1, 0, 0}, {4, 1, 0, 1, 0}};
  radiosity::Grid first, second;
  first.elementCount = 2;
  second.firstElement = 2;
  second.elementCount = 1;
  discretization.grids = {first, second};
  return discretization;
}

}  // namespace

TEST_CASE("errors of radiosity are weighted by area and relative to the truth", "[algebra]") {
  const radiosity::Discretization discretization = threeElements();
  const std::vector<glm::dvec3> truth{{1, 1, 0}, {0, 2, 0}, {2, 1, 1}};  // bands sum to 2, 2, 4
  const std::vector<glm::dvec3> found{{2, 0, 0}, {0, 2, 0}, {2, 2, 1}};  // off by 2 (signs do not cancel), 0, 1
  // Flux is 2 + 6 + 16 = 24 over an area of 8, on average 3.
  const reference::RadiosityError all = reference::errorOf(discretization, found, truth);
  CHECK(all.fluxWeighted == Approx((1 * 2 + 4 * 1) / 24.0));
  CHECK(all.rms == Approx(std::sqrt((1 * 4 + 4 * 1) / 8.0) / 3));
  CHECK(all.maximum == Approx(2 / 3.0));

  const std::vector<reference::RadiosityError> surfaces = reference::errorsBySurface(discretization, found, truth);
  REQUIRE(surfaces.size() == 2);
  CHECK(surfaces[0].fluxWeighted == Approx(2 / 8.0));
  CHECK(surfaces[1].fluxWeighted == Approx(4 / 16.0));
  CHECK(surfaces[1].maximum == Approx(1 / 4.0));

  CHECK(reference::errorsByElement(found, truth) == std::vector<double>{1, 0, 0.25});
}

TEST_CASE("an element that is rightly dark has no error, one that should be dark an infinite one", "[algebra]") {
  const std::vector<glm::dvec3> truth{glm::dvec3(0), glm::dvec3(0), glm::dvec3(1)};
  const std::vector<glm::dvec3> found{glm::dvec3(0), glm::dvec3(1), glm::dvec3(1)};
  CHECK(reference::errorsByElement(found, truth) == std::vector<double>{0, HUGE_VAL, 0});
  CHECK(reference::errorOf(threeElements(), truth, truth).fluxWeighted == 0);
}
