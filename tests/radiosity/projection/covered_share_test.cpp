/// coveredShare: the light through the pixels of a triangle that nothing hides.
#include "radiosity/projection/covered_share.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

struct DrawnPoint {
  explicit DrawnPoint(Scene of, int resolution = 64)
      : scene(std::move(of)),
        elements(discretize(scene, {.texels = 1})),
        factors(scene, elements, layOut(elements), {.resolution = resolution}) {}

  /// The view from a point of the first surface.
  View view(const glm::dvec2& weights) {
    const SurfacePoint point = pointOn(scene.surfaces[0], 0, weights);
    return factors.uncorrected().viewFrom({.surface = 0, .point = point, .up = {}, .area = 1});
  }
  double covered(const View& view, std::uint32_t surface) const {
    double sum = 0;
    for (const Triangle& triangle : scene.surfaces[surface].triangles) {
      std::array<glm::dvec3, 3> corners = triangle.position;
      for (glm::dvec3& corner : corners) corner -= scene.origin;
      sum += coveredShare(*view.projection, view.faces, corners);
    }
    return sum;
  }

  Scene scene;
  Discretization elements;
  SceneFormFactors factors;
};

}  // namespace

TEST_CASE("coveredShare of the walls of an empty room sums to 1: each pixel centre is in one wall", "[covered_share]") {
  Scene room = makeRoom();
  std::swap(room.surfaces[0], room.surfaces[2]);  // the floor is the first
  DrawnPoint drawn(std::move(room));
  for (const glm::dvec2& weights : {glm::dvec2(0.31, 0.27), glm::dvec2(0.05, 0.9), glm::dvec2(0.61, 0.02)}) {
    const View view = drawn.view(weights);
    double sum = 0;
    for (std::uint32_t wall = 1; wall < 6; ++wall) sum += drawn.covered(view, wall);
    CHECK(sum == Approx(1).margin(1e-9));
    CHECK(drawn.covered(view, 0) == 0);  // its own plane
  }
}

TEST_CASE("coveredShare of a triangle that nothing hides is the light of its drawn pixels", "[covered_share]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto place = [&] { return glm::dvec3(unit(random), 1.1 + unit(random), unit(random)); };
  double differences = 0;
  for (int n = 0; n < 100; ++n) {
    const glm::dvec3 a = place(), b = place(), c = place();
    Surface floor = parallelogram("floor", {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), single = floor, back = floor;
    single.name = "single";
    back.name = "back";
    single.triangles.resize(1);
    back.triangles.resize(1);
    single.triangles[0].position = {a, b, c};
    back.triangles[0].position = {a, c, b};
    DrawnPoint drawn(sceneOf({floor, single}));
    const View view = drawn.view({0.3, 0.3});
    const FormFactorRow row = drawn.factors.uncorrected().ofView(view);
    const double seen = row.elements.empty() ? 0 : formFactor(row.shares[0]);
    const double covered = drawn.covered(view, 1);
    CAPTURE(n, seen, covered);
    // The renderer snaps corners to 1/256 of a pixel, so that few pixels at edges differ. A pixel has at most 3.1e-4.
    CHECK(std::abs(seen - covered) < 2e-3);
    differences += std::abs(seen - covered);
    // One of the two windings shows its back.
    CHECK((covered == 0) == (DrawnPoint(sceneOf({floor, back})).covered(view, 1) > 0 || seen == 0));
  }
  CHECK(differences / 100 < 1e-4);
}
