#include <algorithm>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "reference/truth/closed_forms/polygon_to_polygon.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/accuracy/form_factor_cases.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"
#include "tests/support/outline_bound.h"
#include "tests/support/receivers.h"

namespace hemitex::accuracy {
namespace {

using namespace radiosity;

constexpr std::uint32_t from = 0;

std::vector<glm::dvec3> quadOf(const Surface& surface) {
  const auto &a = surface.triangles[0].position, &b = surface.triangles[1].position;
  return {a[0], a[1], a[2], b[2]};
}

/// The eye of a hemicube over a point: lifted off its surface and moved into the triangle.
SurfacePoint eyeOver(const Scene& scene, const SurfacePoint& point) {
  const auto& [a, b, c] = scene.surfaces[from].triangles[point.triangle].position;
  const glm::dvec3 inward = (a + b + c) / 3.0 - point.position;
  const double share = std::min(0.5, eyeInset * scene.extent / glm::length(inward));
  return {point.position + share * inward + eyeHeight * scene.extent * point.normal, point.normal, point.triangle};
}

FromCentres fromCentres(const Scene& scene, std::uint32_t to, int centresAlongSide) {
  tests::HemicubeWorld world(scene, centresAlongSide, 1);
  ProjectedFormFactors rows = world.rows(hemicubeResolution);
  const std::vector<glm::dvec3> receiver = quadOf(scene.surfaces[to]);
  FromCentres mean{};
  const Grid& grid = world.discretization.grids[from];
  for (std::uint32_t p = grid.firstPatch; p < grid.firstPatch + grid.patchCount; ++p) {
    const SurfacePoint centre = patchCentre(world.scene, world.discretization, world.discretization.patches.list[p]);
    const FormFactorRow row = rows.from(from, centre);
    for (std::size_t i = 0; i < row.elements.size(); ++i)
      if (world.discretization.elements[row.elements[i]].surface == to)
        mean.hemicubes += formFactor(row.shares[i]) / grid.patchCount;
    const SurfacePoint eye = eyeOver(scene, centre);
    mean.closedForm += reference::pointToPolygon(eye.position, eye.normal, receiver) / grid.patchCount;
    mean.aliasing += tests::outlineBound(eye, receiver, hemicubeResolution) / grid.patchCount;
    mean.lost += formFactor(row.background + row.back) / grid.patchCount;
  }
  return mean;
}

}  // namespace

FormFactorAnswers answersTo(const FormFactorCase& extreme) {
  const Scene scene = tests::sceneOf(extreme.surfaces);
  const std::uint32_t to = extreme.to;
  const Discretization whole = discretize(scene, {.texels = 1});
  const reference::RayFormFactors rays(scene, whole);
  const std::vector<std::uint32_t> shooting = reference::elementsOfSurface(whole, from);
  const reference::RaySource raySource = reference::areaRaySource(rays.pieces(), shooting);
  const reference::MeasuredRow everywhere =
      rays.overHemisphere(raySource, reference::everyElement(whole), {raySamples});
  return {reference::polygonToPolygon(quadOf(scene.surfaces[from]), quadOf(scene.surfaces[to])),
          rays.aimed(raySource, tests::onlyElement(whole, to), {raySamples}).receivers[0],
          everywhere.receivers[to],
          everywhere.background.value + everywhere.back.value,
          fromCentres(scene, to, 1),
          fromCentres(scene, to, 8)};
}

double errorOf(double value, const FormFactorCase& extreme) {
  const double error = std::abs(value - extreme.exact);
  return extreme.exact > 0 ? error / extreme.exact : error;
}

}  // namespace hemitex::accuracy
