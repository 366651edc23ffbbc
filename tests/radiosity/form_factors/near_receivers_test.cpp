/// NearReceivers compared with closed forms.
#include "radiosity/form_factors/near_receivers.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

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

/// The shares of the light of the surface `lamp` that elements receive.
std::vector<double> sharesOfLamp(const Scene& scene, const Discretization& discretization) {
  SceneFormFactors drawn(scene, discretization, layOut(discretization), {.resolution = 64});
  std::vector<double> shares(discretization.elements.size());
  double area = 0;
  for (const Patch& patch : splitAll(discretization.patches, drawn.splits()).list) {
    if (scene.surfaces[patch.surface].name != "lamp") continue;
    const FormFactorRow row = drawn.row(patch);
    area += patch.area;
    for (std::size_t i = 0; i < row.elements.size(); ++i)
      shares[row.elements[i]] += patch.area * formFactor(row.shares[i]);
  }
  for (double& share : shares) share /= area;
  return shares;
}

/// The scene with light from the surface `lamp`.
Scene lit(Scene scene) {
  scene.materials.push_back(scene.materials.front());
  scene.materials.back().emission = glm::dvec3(1);
  for (Surface& surface : scene.surfaces)
    if (surface.name == "lamp") surface.material = 1;
  return scene;
}

}  // namespace

TEST_CASE("NearReceivers gives elements beside a lamp their light down to contact", "[form-factors]") {
  // A strip of 40 cm x 2 cm looks down on a board of 1 m x 40 cm at some height, and touches a wall with its long side.
  const double height = GENERATE(0.002, 0.02, 0.1);
  CAPTURE(height);
  const Scene scene = lit(tests::sceneOf({tests::parallelogram("board", {0, 0, 0}, {1, 0, 0}, {0, 0.4, 0}),
                                          tests::parallelogram("lamp", {0.3, 0, height}, {0, 0.02, 0}, {0.4, 0, 0}),
                                          tests::parallelogram("wall", {0, 0, 0}, {0, 0, height}, {1, 0, 0})}));
  const Discretization discretization =
      discretize(scene, {.surfaceTexels = {{"board", {5, 4}}, {"lamp", {1, 4}}, {"wall", {1, 5}}}});
  const std::vector<double> shares = sharesOfLamp(scene, discretization);
  for (const std::uint32_t e : elementsOf(discretization.grids[0])) {
    const double x = 0.2 * (discretization.elements[e].texel % 5), y = 0.1 * (discretization.elements[e].texel / 5);
    const double exact = tests::parallelRectangles({{0.3, 0.7}, {0, 0.02}}, {{x, x + 0.2}, {y, y + 0.1}}, height);
    CAPTURE(x, y);
    if (exact > 0.01) CHECK(shares[e] == Approx(exact).epsilon(0.01));
  }
  for (const std::uint32_t e : elementsOf(discretization.grids[2])) {
    const double x = 0.2 * discretization.elements[e].texel;
    const double exact = tests::perpendicularRectangles({{0.3, 0.7}, {0, 0.02}}, {{x, x + 0.2}, {0, height}});
    CAPTURE(x);
    if (exact > 0.01) CHECK(shares[e] == Approx(exact).epsilon(0.01));
  }
}

TEST_CASE("NearReceivers gives the form factor of a floor to a narrow strip at its border", "[form-factors]") {
  // Howell C-14.
  constexpr double height = 0.01;
  const double exact = tests::perpendicularRectangles({{0, 1}, {0, 1}}, {{0, 1}, {0, height}});
  const Scene scene = floorAndStrip(height);
  CHECK(shareOf(rowOfFloor(scene, true), 1) == Approx(exact).epsilon(0.015));
  // From the centre of the floor, half a metre away, much less of the strip is seen.
  CHECK(shareOf(rowOfFloor(scene, false), 1) < 0.5 * exact);
}

TEST_CASE("NearReceivers keeps rows closed, and those without small elements as they are", "[form-factors]") {
  const FormFactorRow narrow = rowOfFloor(floorAndStrip(0.01), true);
  CHECK(std::accumulate(narrow.shares.begin(), narrow.shares.end(), narrow.background + narrow.back) == wholeShare);
  const Scene wide = floorAndStrip(1);
  CHECK(rowOfFloor(wide, true).shares == rowOfFloor(wide, false).shares);
}
