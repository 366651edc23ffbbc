#include "tests/accuracy/size_cases.h"

#include <cmath>
#include <numeric>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/solver/progressive_solver.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/accuracy/form_factor_cases.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"
#include "tests/support/outline_bound.h"
#include "tests/truth/rectangles.h"

namespace hemitex::accuracy {
namespace {

using namespace radiosity;

reference::MeasuredRow hemisphereRow(const Scene& scene, const reference::Receivers& receivers,
                                     const Discretization& discretization) {
  const reference::RayFormFactors rays(scene, discretization);
  const auto raySource = reference::areaRaySource(rays.pieces(), reference::elementsOfSurface(discretization, 0));
  return rays.overHemisphere(raySource, receivers, {raySamples});
}

}  // namespace

OneSurfaceFindings ofOneSurface() {
  Scene scene = tests::sceneOf({tests::parallelogram("alone", {}, {1, 0, 0}, {0, 1, 0})});
  scene.materials[0].emission = glm::dvec3(1);
  tests::HemicubeWorld world(std::move(scene), 1, 1);
  ProjectedFormFactors rows = world.rows(hemicubeResolution);
  const auto rowOf = [&](const radiosity::Patch& patch) { return rows.ofPatch(patch); };
  const Energy energy = solve({.scene = world.scene,
                               .discretization = world.discretization,
                               .patches = world.discretization.patches,
                               .rowOf = rowOf})
                            .energy;
  const auto receivers = reference::everyElement(world.discretization);
  return {formFactor(rowOf(world.discretization.patches.list[0]).background),
          hemisphereRow(world.scene, receivers, world.discretization).background.value,
          energy.lost[0] / energy.emitted[0]};
}

MillionFindings ofAMillionSurfaces() {
  constexpr int n = 1000;
  const auto at = [](int i) { return double(i) / n; };
  std::vector<Surface> surfaces{tests::parallelogram("floor", {}, {1, 0, 0}, {0, 1, 0})};
  for (int i = 0; i < n * n - 1; ++i) {
    const int column = i % n, row = i / n;
    const glm::dvec3 corner(at(column), at(row), 1), across(at(column + 1), at(row), 1),
        along(at(column), at(row + 1), 1), opposite(at(column + 1), at(row + 1), 1);
    surfaces.push_back(tests::quad("tile" + std::to_string(i), {corner, along, opposite, across}));
  }
  tests::HemicubeWorld world(tests::sceneOf(std::move(surfaces)), 1, 1);
  const SurfacePoint centre = patchCentre(world.scene, world.discretization, world.discretization.patches.list[0]);
  const FormFactorRow row = world.rows(hemicubeResolution).from(0, centre);
  const std::uint64_t arriving = std::accumulate(row.shares.begin(), row.shares.end(), std::uint64_t{0});
  // The ceiling, and its last tile, which is missing.
  const std::vector<glm::dvec3> ceiling{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const std::vector<glm::dvec3> missing{{at(n - 1), at(n - 1), 1}, {at(n - 1), 1, 1}, {1, 1, 1}, {1, at(n - 1), 1}};
  const auto fromCentre = [&](const std::vector<glm::dvec3>& polygon) {
    return reference::pointToPolygon(centre.position, centre.normal, polygon);
  };
  const double exactAtCentre = fromCentre(ceiling) - fromCentre(missing);
  const tests::AxisRectangle square{{0, 1}, {0, 1}}, corner{{at(n - 1), 1}, {at(n - 1), 1}};
  const double exact = tests::parallelRectangles(square, square, 1) - tests::parallelRectangles(square, corner, 1);
  // All tiles are one receiver.
  const auto elements = static_cast<std::uint32_t>(world.discretization.elements.size());
  reference::Receivers tiles{1, std::vector<std::uint32_t>(elements, 0)};
  tiles.ofElement[0] = reference::Receivers::none;
  const reference::Measurement measured = hemisphereRow(world.scene, tiles, world.discretization).receivers[0];
  return {elements,
          std::abs(formFactor(arriving) - exactAtCentre) / exactAtCentre,
          (tests::outlineBound(centre, ceiling, hemicubeResolution) +
           tests::outlineBound(centre, missing, hemicubeResolution)) /
              exactAtCentre,
          row.back == 0 && arriving + row.background == wholeShare,
          std::abs(measured.value - exact) / exact,
          measured.standardError / exact};
}

}  // namespace hemitex::accuracy
