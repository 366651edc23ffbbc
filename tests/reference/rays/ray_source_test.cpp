// Ray sources: points of uniform density over the area, at the right places.
#include "reference/rays/ray_source.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "reference/closed_forms/surface_pieces.h"
#include "reference/rays/ray_caster.h"
#include "reference/rays/sample_points.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;

TEST_CASE("shootingPoint gives equal areas equal numbers of points", "[raySource]") {
  // A net of 2^12 points on the triangles of a warped quad and of a patch of it. A triangle is an interval of one
  // coordinate, so its number of points differs from its share of the area by less than two.
  const Scene scene = tests::sceneOf({tests::quad("warped", {{{0, 0, 0}, {2, 0, 1}, {2, 3, -1}, {0, 1, 2}}})});
  const Discretization discretization = discretize(scene, {.texels = 4, .patch = 2});
  const SurfacePieces pieces = surfacePieces(scene, discretization);
  const SamplePoints points(1 << 12, 0);
  for (const auto& elements : {elementsOfSurface(discretization, 0), elementsOfPatch(discretization, 1)}) {
    const RaySource raySource = areaRaySource(pieces, elements);
    double whole = 0, share = 0;
    for (const ShootingTriangle& t : raySource.triangles)
      whole += glm::length(glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
    double expected = 0;
    for (const std::uint32_t element : elements) expected += discretization.elements[element].area;
    CHECK(whole / 2 * scene.extent * scene.extent == Approx(expected).epsilon(1e-11));
    for (std::size_t t = 0; t < raySource.triangles.size(); ++t) {
      const auto& [a, b, c] = raySource.triangles[t].corner;
      const double before = share;
      share += glm::length(glm::cross(b - a, c - a)) / whole;
      CHECK(raySource.upTo[t] == Approx(share).epsilon(1e-12));
      int inside = 0;
      for (std::size_t i = 0; i < points.count(); ++i) {
        const SamplePoint p = points.at(0, i);
        if (p[0] < before || p[0] >= share) continue;
        ++inside;
        const ShootingPoint point = shootingPoint(raySource, p[0], p[1]);
        CHECK(point.triangle == raySource.triangles[t].triangle);
        CHECK(std::abs(glm::dot(point.position - a, point.normal)) < 1e-15);
      }
      CHECK(std::abs(inside - (share - before) * 4096) < 2);
    }
  }
}

TEST_CASE("shootingPoint gives points with the centroid and the second moments of a triangle", "[raySource]") {
  // Over a triangle the mean of the weights is 1/3, that of their squares 1/6 and that of their products 1/12.
  const RaySource raySource{{{{glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}, glm::normalize(glm::dvec3(1)), 0}}, {1.0}};
  const SamplePoints points(1 << 14, 0);
  glm::dvec3 mean(0), squares(0), products(0);
  for (std::size_t i = 0; i < points.count(); ++i) {
    const SamplePoint p = points.at(0, i);
    const glm::dvec3 w = shootingPoint(raySource, p[0], p[1]).position;
    mean += w / 16384.0;
    squares += w * w / 16384.0;
    products += w * glm::dvec3(w.y, w.z, w.x) / 16384.0;
  }
  for (int k = 0; k < 3; ++k) {
    CHECK(mean[k] == Approx(1 / 3.0).margin(1e-4));
    CHECK(squares[k] == Approx(1 / 6.0).margin(1e-4));
    CHECK(products[k] == Approx(1 / 12.0).margin(1e-4));
  }
}

TEST_CASE("pointRaySource puts a point into the plane of its triangle and off its edges, also far from zero",
          "[raySource]") {
  for (const double distance : {0.0, 1e6, 1e8}) {
    INFO("moved by " << distance);
    Scene scene = tests::sceneOf({tests::parallelogram("tilted", glm::dvec3(distance), {1, 0.3, 0.2}, {-0.1, 1, 0.4})});
    const Discretization discretization = discretize(scene, {.texels = 2});
    // The middle of a quad lies on its diagonal.
    const SurfacePoint middle = patchCentre(scene, discretization, discretization.patches[0]);
    const RaySource raySource = pointRaySource(scene, 0, middle);
    const ShootingPoint point = shootingPoint(raySource, 0.3, 0.8);
    const auto [a, b, c] = inFrame(scene, scene.surfaces[0].triangles[middle.triangle]);
    CHECK(glm::length(point.position - inFrame(scene, middle.position)) < 1e-8 + 4e-16 * distance);
    CHECK(std::abs(glm::dot(point.position - a, middle.normal)) < 1e-15);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
      if (distance == 0) CHECK(glm::dot(glm::cross(q - p, point.position - p), n) > 1e-11);
  }
}
