// A room of two sheets, and a third sheet that is near or far.
#include "radiosity/solver/loss_warning.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Five unit squares, the last one at a distance.
Scene sheets(double distance) {
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    const double z = i;
    scene.surfaces.push_back(tests::quad("sheet-" + std::to_string(i), {{{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}}));
  }
  const double d = distance;
  scene.surfaces.push_back(tests::quad("stray", {{{d, 0, 0}, {d + 1, 0, 0}, {d + 1, 1, 0}, {d, 1, 0}}}));
  return scene;
}

Energy lost(double share) {
  Energy energy;
  energy.emitted = Bands(3, 10);
  energy.lost = Bands(3, 10 * share);
  return energy;
}

}  // namespace

TEST_CASE("lossWarning names the surface that is far from all others, at any place of the list", "[solver]") {
  Scene scene = sheets(1e9);
  for (std::size_t place = 0; place < scene.surfaces.size(); ++place) {
    std::rotate(scene.surfaces.begin(), scene.surfaces.begin() + 1, scene.surfaces.end());
    const auto warning = lossWarning(scene, lost(0.9995));
    REQUIRE(warning);
    CHECK_THAT(*warning,
               Catch::StartsWith("100 % of the emitted flux left the scene. The surface `stray` is 1e+09 units"));
  }
}

TEST_CASE("lossWarning names no surface of a scene without a far one", "[solver]") {
  const auto warning = lossWarning(sheets(3), lost(0.995));
  REQUIRE(warning);
  CHECK_THAT(*warning, Catch::StartsWith("99.5 % of the emitted flux left the scene") && !Catch::Contains("stray"));
}

TEST_CASE("lossWarning is silent if surfaces or backs receive more than 1 % of the flux", "[solver]") {
  CHECK_FALSE(lossWarning(sheets(1e9), lost(0.98)));
  CHECK_FALSE(lossWarning(sheets(1e9), Energy{}));
  Energy toBacks = lost(1);
  toBacks.lostToBacks = Bands(3, 1);
  CHECK_FALSE(lossWarning(sheets(1e9), toBacks));
}
