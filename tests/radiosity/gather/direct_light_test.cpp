/// DirectLight against closed forms: lamps, suns, and the visible part of a face behind an edge.
#include "radiosity/gather/direct_light.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "radiosity/geometry/convex_part.h"
#include "tests/support/box_scene.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// A floor of 4 x 4, and a sheet over its part with x < 0, at a height of 1/2.
Scene floorUnderSheet() {
  Scene scene;
  scene.materials = {material("grey", glm::dvec3(0.5), glm::dvec3(0)),
                     material("lamp", glm::dvec3(0.5), glm::dvec3(3, 2, 1))};
  scene.surfaces = {quad("floor", {{{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}}),
                    quad("sheet", {{{-2, 0.5, -2}, {-2, 0.5, 2}, {0, 0.5, 2}, {0, 0.5, -2}}})};
  return finish(std::move(scene));
}

LitPlace onFloor(double x, double z) { return {0, {{x, 0, z}, {0, 1, 0}, 0}}; }

/// The form factor from a point of the floor to the rectangle [low, 0.25] x [-0.25, 0.25] at a height of 1.
double toRectangle(const glm::dvec3& point, double low) {
  const glm::dvec3 a(low, 1, -0.25), b(0.25, 1, -0.25), c(0.25, 1, 0.25), d(low, 1, 0.25), up(0, 1, 0);
  return fromPoint(point, up, inFrontOf({a, b, c}, point, up)) + fromPoint(point, up, inFrontOf({a, c, d}, point, up));
}

}  // namespace

TEST_CASE("DirectLight of a face behind an edge is the closed form of its visible part", "[direct_light]") {
  Scene scene = floorUnderSheet();
  scene.surfaces.push_back(quad("lamp", {{{-0.25, 1, -0.25}, {0.25, 1, -0.25}, {0.25, 1, 0.25}, {-0.25, 1, 0.25}}}, 1));
  const Discretization discretization = discretize(scene, {.texels = 1});
  const DirectLight direct(scene, discretization);
  REQUIRE(direct.count() == 1);
  CHECK(direct.hasEmissionOf(2));
  CHECK_FALSE(direct.hasEmissionOf(0));
  CHECK(direct.light(0)[0] == 3);
  for (double x = -0.6; x < 0.61; x += 0.05) {
    const LitPlace place = onFloor(x + 0.003, 0.1);
    const double all = toRectangle(place.point.position, -0.25);
    CHECK(direct.factor(0, place.point) == Approx(all).epsilon(1e-12));
    // The line from the place to a point e of the lamp passes beside the sheet if e.x > -x.
    const double low = std::clamp(-place.point.position.x, -0.25, 0.25);
    const double seen = direct.factor(0, place.point) * direct.visibleShare(0, place);
    CHECK(seen == Approx(toRectangle(place.point.position, low)).margin(0.02 * all));
    const double probed = direct.probedShare(0, place);
    const double aside = std::abs(place.point.position.x);
    if (aside < 0.24) CHECK((probed > 0 && probed < 1));
    if (aside > 0.26) CHECK(probed == (place.point.position.x > 0 ? 1 : 0));
  }
  // The lamp has no light on its back.
  CHECK(direct.factor(0, {{0, 2, 0}, {0, -1, 0}, 0}) == 0);
}

TEST_CASE("DirectLight of a lamp and a sun is their closed form, and nothing below the sheet", "[direct_light]") {
  Scene scene = floorUnderSheet();
  scene.lamps = {{"lamp", {0.5, 2, 0}, {8, 4, 2}}};
  scene.outside.suns = {{glm::normalize(glm::dvec3(1, 2, 0)), {5, 5, 5}}};
  scene.squareMetres = 4;
  const Discretization discretization = discretize(scene, {.texels = 1});
  const DirectLight direct(scene, discretization);
  REQUIRE(direct.count() == 2);
  const LitPlace open = onFloor(1.5, 0), hidden = onFloor(-1, 0);
  CHECK(direct.factor(0, open.point) == Approx(2 / std::sqrt(5)));
  CHECK(direct.light(1)[0] == 2);  // 8 W/sr over 4 m^2 per square unit
  CHECK(direct.factor(1, open.point) == Approx(2 / std::pow(5, 1.5)));
  for (const std::size_t source : {0, 1}) {
    CHECK(direct.visibleShare(source, open) == 1);
    CHECK(direct.visibleShare(source, hidden) == 0);
    CHECK(direct.probedShare(source, open) == 1);
    CHECK(direct.probedShare(source, hidden) == 0);
  }
  // The sun's shadow ends at x = -1/4, of which a texel around it has half.
  LitPlace edge = onFloor(-0.25, 0);
  edge.along1 = {0.1, 0, 0};
  edge.along2 = {0, 0, 0.1};
  CHECK(direct.visibleShare(0, edge) == Approx(0.5).margin(0.02));
}
