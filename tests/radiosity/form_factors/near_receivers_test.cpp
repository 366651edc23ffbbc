/// NearReceivers compared with closed forms.
#include "radiosity/form_factors/near_receivers.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A floor of 1 m x 1 m, and at its border a strip of 1 m x `height` that faces it.
Scene floorAndStrip(double height) {
  return tests::sceneOf({tests::parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                         tests::parallelogram("strip", {1, 0, 0}, {-1, 0, 0}, {0, 0, height})});
}

/// The row of the only patch of the floor, corrected or as it is drawn.
FormFactorRow rowOfFloor(const Scene& scene, bool isCorrected) {
  const Discretization discretization = discretize(scene, {.texels = 1});
  SceneFormFactors drawn(scene, discretization, layOut(discretization), {.resolution = 256});
  const Patch& patch = discretization.patches.list.front();
  return isCorrected ? drawn.row(patch) : drawn.uncorrected().ofPatch(patch);
}

double shareOf(const FormFactorRow& row, std::uint32_t element) {
  for (std::size_t i = 0; i < row.elements.size(); ++i)
    if (row.elements[i] == element) return formFactor(row.shares[i]);
  return 0;
}

}  // namespace

TEST_CASE("NearReceivers gives the form factor of a floor to a narrow strip at its border", "[form-factors]") {
  // Howell C-14. The strip is a 100th of the floor, so that the hemicube over its centre has an error of 1 % by its
  // pixels (64 along a side); the floor fills half of its view, and F varies by less along the strip than that.
  constexpr double height = 0.01;
  const double exact = tests::perpendicularRectangles({{0, 1}, {0, 1}}, {{0, 1}, {0, height}});
  const Scene scene = floorAndStrip(height);
  CHECK(shareOf(rowOfFloor(scene, true), 1) == Approx(exact).epsilon(0.02));
  // From the centre of the floor, half a metre away, much less of the strip is seen.
  CHECK(shareOf(rowOfFloor(scene, false), 1) < 0.5 * exact);
}

TEST_CASE("NearReceivers keeps rows closed, and those without small elements as they are", "[form-factors]") {
  const FormFactorRow narrow = rowOfFloor(floorAndStrip(0.01), true);
  CHECK(std::accumulate(narrow.shares.begin(), narrow.shares.end(), narrow.background + narrow.back) == wholeShare);
  const Scene wide = floorAndStrip(1);
  CHECK(rowOfFloor(wide, true).shares == rowOfFloor(wide, false).shares);
}
