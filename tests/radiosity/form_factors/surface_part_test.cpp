/// Exchange areas of parts of surfaces compared with closed forms.
#include "radiosity/form_factors/surface_part.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// The exchange area of the first two surfaces of a scene, which have one element each.
double exchanged(const Scene& scene) {
  const Discretization discretization = discretize(scene, {.texels = 1});
  return exchangeArea(partOf(scene, discretization, 0), partOf(scene, discretization, 1), RayTree(scene),
                      {.height = contactTolerance(scene)});
}

/// A square of side 1 and a strip at right angles along the middle of its border.
std::vector<Surface> squareAndStrip(double width) {
  return {tests::parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
          tests::parallelogram("strip", {0.3, 0, 0}, {0, 0, width}, {0.4, 0, 0})};
}

}  // namespace

TEST_CASE("exchangeArea of rectangles that touch is the closed form", "[form-factors]") {
  const double width = GENERATE(1.0, 0.1, 0.001);
  const double factor = tests::perpendicularRectangles({{0.3, 0.7}, {0, width}}, {{0, 1}, {0, 1}});
  CHECK(exchanged(tests::sceneOf(squareAndStrip(width))) == Approx(0.4 * width * factor).epsilon(0.005));
}

TEST_CASE("exchangeArea of parallel rectangles is the closed form, and the same from both", "[form-factors]") {
  const double gap = GENERATE(1.0, 0.1, 0.002);
  const double factor = tests::parallelRectangles({{0.2, 0.6}, {0.3, 0.32}}, {{0, 1}, {0, 1}}, gap);
  std::vector<Surface> surfaces{tests::parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("strip", {0.2, 0.3, gap}, {0, 0.02, 0}, {0.4, 0, 0})};
  const double exchange = exchanged(tests::sceneOf(surfaces));
  CHECK(exchange == Approx(0.008 * factor).epsilon(0.005));
  std::swap(surfaces[0], surfaces[1]);
  CHECK(exchanged(tests::sceneOf(surfaces)) == exchange);
}

TEST_CASE("exchangeArea has the share that a blocker leaves visible", "[form-factors]") {
  // The sheet hides the half of the strip's view that the square fills.
  std::vector<Surface> surfaces{tests::parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("strip", {0.4, 0.4, 1}, {0, 0.2, 0}, {0.2, 0, 0})};
  const double all = exchanged(tests::sceneOf(surfaces));
  surfaces.push_back(tests::parallelogram("sheet", {0, 0, 0.001}, {0.5, 0, 0}, {0, 1, 0}));
  CHECK(exchanged(tests::sceneOf(surfaces)) == Approx(0.5 * all).epsilon(0.05));
  surfaces.push_back(tests::parallelogram("other half", {0.5, 0, 0.001}, {0.5, 0, 0}, {0, 1, 0}));
  CHECK(exchanged(tests::sceneOf(surfaces)) == 0);
}
