/// Gathered rows of lamps compared with closed forms.
#include "radiosity/form_factors/gathered_rows.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr int texels = 16;

/// A floor [0, 1]^2 of 16 x 16 elements, a lamp of the same size at this height, and blockers.
struct LampOverFloor {
  Scene scene;
  Discretization discretization;

  LampOverFloor(double height, const std::vector<Surface>& blockers) {
    std::vector<Surface> surfaces{tests::parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                  tests::parallelogram("lamp", {0, 0, height}, {0, 1, 0}, {1, 0, 0})};
    surfaces.insert(surfaces.end(), blockers.begin(), blockers.end());
    scene = tests::sceneOf(surfaces);
    scene.materials.push_back(tests::material("light", glm::dvec3(0), glm::dvec3(1)));
    scene.surfaces[1].material = static_cast<int>(scene.materials.size()) - 1;
    discretization = discretize(scene, {.texels = 1, .surfaceTexels = {{"floor", texels}}});
  }

  FormFactorRow row() const {
    SceneFormFactors drawn(scene, discretization, layOut(discretization), {.resolution = 256, .gathersDirect = true});
    return drawn.row(discretization.patches.list[discretization.grids[1].firstPatch]);
  }
};

double shareOf(const FormFactorRow& row, int column, int line) {
  const auto element = static_cast<std::uint32_t>(line * texels + column);
  for (std::size_t i = 0; i < row.elements.size(); ++i)
    if (row.elements[i] == element) return formFactor(row.shares[i]);
  return 0;
}

tests::AxisRectangle rectangleOf(int column, int line) {
  constexpr double size = 1.0 / texels;
  return {{column * size, (column + 1) * size}, {line * size, (line + 1) * size}};
}

}  // namespace

TEST_CASE("Gathered rows are the closed forms from a lamp to elements, far and near", "[form-factors]") {
  // The form factor changes within an element by the square of its size over the distance. A far element has one point;
  // points of near ones are a fourth of the distance apart, so that the rule of midpoints is off by 1/96 of the second
  // derivative, which is at most 2 at a peak of cos^4. Shares may be scaled by half a percent.
  const auto [height, tolerance] = GENERATE(std::pair(1.0, 0.007), std::pair(0.05, 0.025));
  const FormFactorRow row = LampOverFloor(height, {}).row();
  for (int line = 0; line < texels; line += 5)
    for (int column = 0; column < texels; ++column) {
      const double exact = tests::parallelRectangles({{0, 1}, {0, 1}}, rectangleOf(column, line), height);
      CHECK(shareOf(row, column, line) == Approx(exact).epsilon(tolerance));
    }
  CHECK(std::accumulate(row.shares.begin(), row.shares.end(), row.background + row.back) == wholeShare);
}

TEST_CASE("Gathered rows have the shadow of a plate over half of the lamp", "[form-factors]") {
  // The plate ends halfway between floor and lamp, at x = 1/2. So a point at x sees the lamp beyond 1 - x.
  const FormFactorRow row =
      LampOverFloor(1, {tests::parallelogram("plate", {-4, -4, 0.5}, {4.5, 0, 0}, {0, 9, 0})}).row();
  for (int column = 0; column < texels; ++column) {
    const tests::AxisRectangle element = rectangleOf(column, 7);
    const double x = (column + 0.5) / texels;
    const double visible = tests::parallelRectangles({{1 - x, 1}, {0, 1}}, element, 1),
                 all = tests::parallelRectangles({{0, 1}, {0, 1}}, element, 1);
    // 4 x 4 points of the lamp, from 2 x 2 points of the element: the edge is found to an eighth of the lamp, and to
    // half of that on average.
    CHECK(std::abs(shareOf(row, column, 7) - visible) < all / 8);
  }
  CHECK(shareOf(row, 15, 7) > 0.9 * tests::parallelRectangles({{0, 1}, {0, 1}}, rectangleOf(15, 7), 1));
}

TEST_CASE("Rows of patches that do not emit are not gathered", "[form-factors]") {
  const LampOverFloor room(1, {});
  SceneFormFactors gathering(room.scene, room.discretization, layOut(room.discretization), {.gathersDirect = true}),
      drawing(room.scene, room.discretization, layOut(room.discretization), {});
  const Patch& patch = room.discretization.patches.list.front();
  CHECK(!gathering.isGathered(patch));
  CHECK(gathering.row(patch) == drawing.row(patch));
}
