// The error of a single hemicube: small random rectangles above its point, compared with closed forms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/software/software_renderer.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A unit direction above the horizon, cosine-distributed.
glm::dvec3 direction(std::mt19937& random) {
  const auto draw = [&random] { return double(random()) / 4294967296.0; };
  const double radius2 = draw(), angle = 2 * M_PI * draw();
  return {std::sqrt(radius2) * std::cos(angle), std::sqrt(radius2) * std::sin(angle), std::sqrt(1 - radius2)};
}

/// A rectangle at a distance of 1 whose front faces the origin, rotated about the line to it and tilted by up to 60
/// degrees.
Surface rectangle(std::mt19937& random) {
  const auto draw = [&random](double low, double high) {
    return low + (high - low) * (double(random()) / 4294967296.0);
  };
  const glm::dvec3 centre = direction(random);
  const double turn = draw(0, 2 * M_PI), lean = draw(-M_PI / 3, M_PI / 3);
  const glm::dvec3 axis = std::abs(centre.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, centre)), up = glm::cross(centre, right);
  const glm::dvec3 along = std::cos(turn) * right + std::sin(turn) * up;
  const glm::dvec3 across = std::cos(lean) * glm::cross(centre, along) + std::sin(lean) * centre;
  const glm::dvec3 u = draw(0.22, 0.56) * across, v = draw(0.22, 0.56) * along;
  return tests::parallelogram("rectangle", centre - 0.5 * (u + v), u, v);
}

struct Errors {
  double mean = 0;      ///< of the form factors
  double rms = 0;       ///< absolute
  double relative = 0;  ///< the median
};

/// For 400 rectangles, always the same.
Errors errorsAt(int resolution) {
  constexpr int rectangles = 400;
  std::mt19937 random(7);
  Errors errors;
  std::vector<double> relative;
  for (int i = 0; i < rectangles; ++i) {
    const Surface floor = tests::parallelogram("floor", {-1e-3, -1e-3, 0}, {2e-3, 0, 0}, {0, 2e-3, 0});
    const Scene scene = tests::sceneOf({floor, rectangle(random)});
    double exact = 0;
    for (const Triangle& triangle : scene.surfaces[1].triangles)
      exact += reference::pointToPolygon(glm::dvec3(0), glm::dvec3(0, 0, 1), triangle.position);
    const Discretization discretization = discretize(scene, {.texels = 1});
    const IdLayout layout = layOut(discretization);
    raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
    const FormFactorRow row =
        ProjectedFormFactors(scene, discretization, layout, renderer, {.resolution = resolution}).ofPatch(0);
    const double found = row.elements.empty() ? 0 : formFactor(row.shares[0]);
    REQUIRE(row.back == 0);
    errors.mean += exact / rectangles;
    errors.rms += (found - exact) * (found - exact) / rectangles;
    relative.push_back(std::abs(found - exact) / exact);
  }
  errors.rms = std::sqrt(errors.rms);
  std::nth_element(relative.begin(), relative.begin() + rectangles / 2, relative.end());
  errors.relative = relative[static_cast<std::size_t>(rectangles / 2)];
  return errors;
}

}  // namespace

TEST_CASE("hemicube has the errors that its pixels imply", "[hemicube]") {
  // The root mean squares and medians were computed by a separate program with exact pixel integrals. It used 400
  // random rectangles with a mean form factor of 0.027, as here. The few largest errors dominate the root mean square.
  // With other rectangles it varies by 13 %; this test allows twice that.
  struct Expected {
    int resolution;
    double rms, relative;
  };
  for (const Expected& expected :
       {Expected{32, 7.9e-4, 0.026}, {64, 2.7e-4, 0.0080}, {128, 9.4e-5, 0.0024}, {256, 3.1e-5, 0.00076}}) {
    const Errors errors = errorsAt(expected.resolution);
    INFO("R = " << expected.resolution << ": " << errors.rms << ", " << errors.relative);
    CHECK(errors.mean == Approx(0.027).epsilon(0.02));
    CHECK(errors.rms < 1.26 * expected.rms);
    CHECK(errors.relative < expected.relative);
  }
}
