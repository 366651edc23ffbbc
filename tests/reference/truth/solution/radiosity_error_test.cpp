// Error measures of solutions, with numbers that can be checked by hand.
#include "reference/truth/solution/radiosity_error.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;

namespace {

/// Two surfaces: elements of areas 1 and 3, and one of area 4.
radiosity::Discretization threeElements() {
  radiosity::Discretization discretization;
  discretization.elements = {{1, 0, 0}, {3, 0, 1}, {4, 1, 0}};
  radiosity::Grid first, second;
  first.elementCount = 2;
  second.firstElement = 2;
  second.elementCount = 1;
  discretization.grids = {first, second};
  return discretization;
}

}  // namespace

TEST_CASE("errorOf weights errors by area, relative to the truth", "[algebra]") {
  const radiosity::Discretization discretization = threeElements();
  const std::vector<glm::dvec3> truth{{1, 1, 0}, {0, 2, 0}, {2, 1, 1}};  // bands sum to 2, 2, 4
  const std::vector<glm::dvec3> found{{2, 0, 0}, {0, 2, 0}, {2, 2, 1}};  // errors of 2 (signs do not cancel), 0, 1
  // Flux is 2 + 6 + 16 = 24 over an area of 8, on average 3.
  const reference::RadiosityError all = reference::errorOf(discretization, found, truth);
  CHECK(all.fluxWeighted == Approx((1 * 2 + 4 * 1) / 24.0));
  CHECK(all.rms == Approx(std::sqrt((1 * 4 + 4 * 1) / 8.0) / 3));
  CHECK(all.maximum == Approx(2 / 3.0));

  const std::vector<glm::dvec3> dark(3, glm::dvec3(0));
  CHECK(reference::errorOf(discretization, dark, dark).fluxWeighted == 0);
}

TEST_CASE("onOtherGrids counts the error of constant coarse elements", "[algebra]") {
  // One surface with a radiosity that rises along its columns: x = 1/16, 3/16, ... 15/16 in eight columns. The coarse
  // solution is exact: its columns have the means of 8/n fine ones. Each coarse column of width 2h = 1/n has fine ones
  // on both sides of its mean. Over four coarse columns the error is 1/16 everywhere. Over two it is 1/16 and 3/16, on
  // average 1/8. Over one it is 1/16, 3/16, 5/16, 7/16, on average 1/4. The mean of the truth is 1/2.
  const radiosity::Scene scene = tests::sceneOf({tests::parallelogram("ramp", {0, 0, 0}, {2, 0, 0}, {0, 3, 0})});
  const radiosity::Discretization fine = radiosity::discretize(scene, {.texels = 8});
  const auto ramp = [](const radiosity::Discretization& discretization) {
    std::vector<glm::dvec3> radiosity;
    for (const radiosity::Element& element : discretization.elements) {
      const auto columns = static_cast<std::uint32_t>(discretization.grids[0].columns);
      radiosity.emplace_back((element.texel % columns + 0.5) / columns);
    }
    return radiosity;
  };
  const std::vector<glm::dvec3> truth = ramp(fine);
  for (const auto& [texels, missed] : {std::pair{8, 0.0}, {4, 1 / 16.0}, {2, 1 / 8.0}, {1, 1 / 4.0}}) {
    const radiosity::Discretization coarse = radiosity::discretize(scene, {.texels = texels});
    const std::vector<glm::dvec3> found = reference::onOtherGrids(coarse, ramp(coarse), fine);
    CHECK(reference::errorOf(fine, found, truth).fluxWeighted == Approx(missed / 0.5).margin(1e-15));
  }
  // In the other direction, the centre of the only texel lies in column and row 4 of 0 ... 7.
  const radiosity::Discretization one = radiosity::discretize(scene, {.texels = 1});
  CHECK(reference::onOtherGrids(fine, truth, one) == std::vector<glm::dvec3>{glm::dvec3(9 / 16.0)});
}
