// The centres of patches and elements lie on the surface, for all kinds of charts.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// The distance from a point to its triangle: to the plane inside, to the edges outside.
double distanceTo(const Triangle& triangle, const glm::dvec3& point) {
  const glm::dvec3 n = normal(triangle);
  double distance = std::abs(glm::dot(n, point - triangle.position[0]));
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& a = triangle.position[k];
    const glm::dvec3 inwards = glm::normalize(glm::cross(n, triangle.position[(k + 1) % 3] - a));
    distance = std::max(distance, -glm::dot(inwards, point - a));
  }
  return distance;
}

bool liesOnSurface(const Scene& scene, std::uint32_t surface, const SurfacePoint& point) {
  const Triangle& triangle = scene.surfaces[surface].triangles.at(point.triangle);
  return distanceTo(triangle, point.position) < 1e-12 * scene.extent &&
         glm::length(point.normal - normal(triangle)) < 1e-15;
}

/// The place of a point on the chart of its surface, in texels.
glm::dvec2 placeOnChart(const Scene& scene, const Grid& grid, std::uint32_t surface, const SurfacePoint& point) {
  const Triangle& triangle = scene.surfaces[surface].triangles[point.triangle];
  const glm::dvec3 e1 = triangle.position[1] - triangle.position[0], e2 = triangle.position[2] - triangle.position[0];
  const glm::dvec3 n = glm::cross(e1, e2), d = point.position - triangle.position[0];
  const double w1 = glm::dot(glm::cross(d, e2), n) / glm::dot(n, n),
               w2 = glm::dot(glm::cross(e1, d), n) / glm::dot(n, n);
  const auto corners = inTexels(triangle, grid.columns, grid.rows);
  return corners[0] + w1 * (corners[1] - corners[0]) + w2 * (corners[2] - corners[0]);
}

bool isInside(const glm::dvec2& point, const glm::dvec2& low, const glm::dvec2& size) {
  const double slack = 1e-6;  // of a texel: slivers of width 1e-6 magnify roundoff in space to this much on the chart
  return glm::all(glm::greaterThanEqual(point, low - slack)) && glm::all(glm::lessThanEqual(point, low + size + slack));
}

}  // namespace

TEST_CASE("patchCentre of each patch lies on its surface, inside its block", "[centres]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  for (const int texels : {1, 7, 16, 45})
    for (const int side : {1, 2, 4, 9}) {
      const Discretization discretization = discretize(scene, {.texels = texels, .patch = side});
      for (const Patch& patch : discretization.patches.list) {
        INFO(scene.surfaces[patch.surface].name << ", " << texels << " texels, block " << patch.column << ","
                                                << patch.row);
        const SurfacePoint centre = patchCentre(scene, discretization, patch);
        REQUIRE(liesOnSurface(scene, patch.surface, centre));
        const glm::dvec2 place = placeOnChart(scene, discretization.grids[patch.surface], patch.surface, centre);
        REQUIRE(isInside(place, {patch.column, patch.row}, {patch.width, patch.height}));
      }
    }
}

TEST_CASE("elementCentre of each element lies on its surface, inside its texel", "[centres]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  for (const int texels : {1, 7, 16, 45}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
      const Element& element = discretization.elements[e];
      INFO(scene.surfaces[element.surface].name << ", " << texels << " texels, texel " << element.texel);
      const SurfacePoint centre = elementCentre(scene, discretization, e);
      REQUIRE(liesOnSurface(scene, element.surface, centre));
      const glm::dvec2 place = placeOnChart(scene, discretization.grids[element.surface], element.surface, centre);
      const glm::dvec2 low(int(element.texel) % texels, int(element.texel) / texels);
      REQUIRE(isInside(place, low, glm::dvec2(1)));
    }
  }
}

TEST_CASE("patchCentre and elementCentre of a parallelogram follow from its edges", "[centres]") {
  const glm::dvec3 corner(10, 20, 30), u(2, 0, 1), v(0, 3, 0);
  const Scene scene = sceneOf({parallelogram("p", corner, u, v)});
  const Discretization discretization = discretize(scene, {.texels = 6, .patch = 4});
  // Blocks of 4 and 2 texels: middles at 2/6 and 5/6.
  const std::array<double, 2> middle{2.0 / 6, 5.0 / 6};
  for (std::size_t p = 0; p < 4; ++p) {
    const glm::dvec3 expected = corner + middle[p % 2] * u + middle[p / 2] * v;
    CHECK(glm::length(patchCentre(scene, discretization, discretization.patches.list[p]).position - expected) < 1e-13);
  }
  for (std::uint32_t e = 0; e < 36; ++e) {
    const glm::dvec3 expected = corner + (e % 6 + 0.5) / 6 * u + (e / 6 + 0.5) / 6 * v;
    CHECK(glm::length(elementCentre(scene, discretization, e).position - expected) < 1e-13);
  }
}

TEST_CASE("patchCentre is the centroid of the surface or, if that is in a hole, lies on the nearest triangle",
          "[centres]") {
  // The L is the lower half, of area 1/2 about (1/2, 1/4), and the upper left quarter about (1/4, 3/4). Its centroid is
  // at (1/2 * 1/2 + 1/4 * 1/4) / (3/4) = 5/12 along both axes. On the ring, one patch has its centroid in the hole.
  const Scene scene = sceneOf({lShape(), ring(64)});
  const Discretization discretization = discretize(scene, {.texels = 4, .patch = 4});
  CHECK(glm::length(patchCentre(scene, discretization, discretization.patches.list[0]).position -
                    glm::dvec3(5 / 12.0, 5 / 12.0, 0)) < 1e-15);
  // The ring's triangles have two corners on one of its circles, of radii 0.2 and 0.5, and one on the other. Those with
  // two on the inner circle are nearest. Their centres are at a third of 0.2 + 0.2 + 0.5, up to the cosine of 1/64 of a
  // circle, which is above 0.995.
  const glm::dvec3 centre = patchCentre(scene, discretization, discretization.patches.list[1]).position;
  const double radius = glm::length(glm::dvec2(centre) - 0.5);
  CHECK(radius <= 0.3);
  CHECK(radius > 0.995 * 0.3);
}

TEST_CASE("patchCentre on the diagonal of a bent quad weights both triangles by their areas", "[centres]") {
  // A block of side s at the diagonal is cut into two triangles with centroids (2/3, 1/3) s and (1/3, 2/3) s. Weighted
  // by areas a and b, that is ((2a + b)/3, (a + 2b)/3) s / (a + b), on the larger triangle.
  const Scene scene = sceneOf({quad("warped", {{{0, 0, 0}, {2, 0, 1}, {2, 3, -1}, {0, 1, 2}}})});
  const double a = area(scene.surfaces[0].triangles[0]), b = area(scene.surfaces[0].triangles[1]);
  REQUIRE(b > 1.05 * a);
  for (const int texels : {2, 3, 10, 48}) {
    const Discretization discretization = discretize(scene, {.texels = texels, .patch = 2});
    for (const Patch& patch : discretization.patches.list) {
      if (patch.column != patch.row || patch.width != patch.height) continue;
      const SurfacePoint centre = patchCentre(scene, discretization, patch);
      CHECK(centre.triangle == 1);
      const glm::dvec2 place = placeOnChart(scene, discretization.grids[0], 0, centre);
      const glm::dvec2 expected =
          double(patch.column) + double(patch.width) * glm::dvec2(2 * a + b, a + 2 * b) / (3 * (a + b));
      CHECK(glm::distance(place, expected) < 1e-13 * texels);
    }
  }
}

TEST_CASE("elementCentre is the centroid of the largest piece if the surface misses the middle of the texel",
          "[centres]") {
  // A triangle with legs of 3/4 does not reach the middle of its one texel, (1/2, 1/2).
  const Scene scene = sceneOf({flat("t", {{glm::dvec2(0, 0), glm::dvec2(0.75, 0), glm::dvec2(0, 0.75)}})});
  const Discretization discretization = discretize(scene, {.texels = 1});
  const glm::dvec3 expected(0.25, 0.25, 0);
  CHECK(glm::length(elementCentre(scene, discretization, 0).position - expected) < 1e-15);
  CHECK(glm::length(patchCentre(scene, discretization, discretization.patches.list[0]).position - expected) < 1e-15);
}
