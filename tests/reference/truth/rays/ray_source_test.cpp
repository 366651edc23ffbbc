// Ray sources: points of uniform density over the area, at the right places, and neighbours that stay neighbours.
#include "reference/truth/rays/ray_source.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "reference/truth/closed_forms/surface_pieces.h"
#include "reference/truth/rays/ray_caster.h"
#include "reference/truth/rays/sample_points.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;

namespace {

/// A surface alone in a scene.
struct SourceWorld {
  Scene scene;
  Discretization discretization;
  SurfacePieces pieces;

  SourceWorld(const Surface& surface, int texels)
      : scene(tests::sceneOf({surface})),
        discretization(discretize(scene, {.texels = texels})),
        pieces(surfacePieces(scene, discretization)) {}

  RaySource source() const { return areaRaySource(pieces, elementsOfSurface(discretization, 0)); }

  std::uint32_t elementAt(const ShootingPoint& point) const {
    const auto [a, b, c] = inFrame(scene, scene.surfaces[0].triangles[point.triangle]);
    const glm::dvec3 doubled = glm::cross(b - a, c - a), offset = point.position - a;
    const double whole = glm::dot(doubled, doubled);
    return reference::elementAt(
        scene.surfaces[0].triangles[point.triangle], discretization.grids[0],
        {glm::dot(glm::cross(offset, c - a), doubled) / whole, glm::dot(glm::cross(b - a, offset), doubled) / whole});
  }
};

double areaOf(const RaySource& source) { return source.columns.back().upTo; }

constexpr int texelsPerSide[] = {1, 5, 16};

}  // namespace

TEST_CASE("areaRaySource has the area of its elements", "[raySource]") {
  for (const Surface& surface : tests::tableOfSurfaces())
    for (const int texels : texelsPerSide) {
      const SourceWorld world(surface, texels);
      double expected = 0;
      for (const Element& element : world.discretization.elements) expected += element.area;
      INFO(surface.name << ", " << texels << " texels");
      CHECK(areaOf(world.source()) * world.scene.extent * world.scene.extent == Approx(expected).epsilon(1e-9));
    }
}

TEST_CASE("shootingPoint maps equal areas to equal areas", "[raySource]") {
  // The area of the image of a tiny square, by finite differences. Squares on a border of texels or slabs are torn.
  constexpr double h = 1e-8;
  const SamplePoints points(1 << 8, 0);
  for (const Surface& surface : tests::tableOfSurfaces())
    for (const int texels : texelsPerSide) {
      const SourceWorld world(surface, texels);
      const RaySource source = world.source();
      const auto at = [&](double x, double y) { return shootingPoint(source, x, y).position; };
      std::size_t equal = 0;
      for (std::size_t i = 0; i < points.count(); ++i) {
        const double x = points.at(0, i)[0], y = points.at(0, i)[1];
        const glm::dvec3 alongX = at(x + h, y) - at(x - h, y), alongY = at(x, y + h) - at(x, y - h);
        equal += std::abs(glm::length(glm::cross(alongX, alongY)) / (4 * h * h) / areaOf(source) - 1) < 0.01;
      }
      INFO(surface.name << ", " << texels << " texels: " << equal << " of " << points.count());
      CHECK(equal >= points.count() * 99 / 100);
    }
}

TEST_CASE("shootingPoint gives points on the triangle that it names", "[raySource]") {
  const SamplePoints points(1 << 8, 0);
  for (const Surface& surface : tests::tableOfSurfaces()) {
    const SourceWorld world(surface, 5);
    const RaySource source = world.source();
    for (std::size_t i = 0; i < points.count(); ++i) {
      const ShootingPoint point = shootingPoint(source, points.at(0, i)[0], points.at(0, i)[1]);
      const Triangle& triangle = world.scene.surfaces[0].triangles[point.triangle];
      const auto [a, b, c] = inFrame(world.scene, triangle);
      CHECK(point.normal == normal(triangle));
      CHECK(std::abs(glm::dot(point.position - a, point.normal)) < 1e-15);
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}})
        CHECK(glm::dot(glm::cross(to - from, point.position - from), point.normal) > -1e-14);
    }
  }
}

TEST_CASE("shootingPoint gives each texel its share of a net", "[raySource]") {
  // The points of a texel come from a rectangle. In a rectangle at the origin, the number of points of a net of 2^m
  // differs from its share by at most m / 2 + 3 / 2 (Niederreiter 1987). Another rectangle is made of four of those.
  constexpr int m = 14;
  const SamplePoints points(1 << m, 0);
  for (const Surface& surface : tests::tableOfSurfaces()) {
    const SourceWorld world(surface, 5);
    const RaySource source = world.source();
    std::vector<int> counts(world.discretization.elements.size());
    for (std::size_t i = 0; i < points.count(); ++i)
      ++counts[world.elementAt(shootingPoint(source, points.at(0, i)[0], points.at(0, i)[1]))];
    const double whole = areaOf(source) * world.scene.extent * world.scene.extent;
    for (std::size_t e = 0; e < counts.size(); ++e) {
      INFO(surface.name << ", element " << e);
      CHECK(std::abs(counts[e] - world.discretization.elements[e].area / whole * (1 << m)) <= 4 * (m / 2 + 1.5));
    }
  }
}

TEST_CASE("shootingPoint is affine on a parallelogram with any number of texels", "[raySource]") {
  const glm::dvec3 corner(1, 2, 3), u(2, 0.5, 0), v(-0.25, 1, 1);
  for (const int texels : {1, 2, 7, 16}) {
    const SourceWorld world(tests::parallelogram("tilted", corner, u, v), texels);
    const RaySource source = world.source();
    const SamplePoints points(1 << 8, 0);
    for (std::size_t i = 0; i < points.count(); ++i) {
      const auto [x, y, ignored, alsoIgnored] = points.at(0, i);
      CHECK(glm::distance(shootingPoint(source, x, y).position, inFrame(world.scene, corner + x * u + y * v)) < 1e-14);
    }
  }
}

TEST_CASE("shootingPoint gives surfaces intervals of x in proportion to their areas", "[raySource]") {
  const Scene scene = tests::sceneOf({tests::parallelogram("three", {0, 0, 0}, {3, 0, 0}, {0, 1, 0}),
                                      tests::parallelogram("one", {0, 0, 1}, {1, 0, 0}, {0, 1, 0})});
  const Discretization discretization = discretize(scene, {.texels = 4});
  std::vector<std::uint32_t> elements(discretization.elements.size());
  std::iota(elements.rbegin(), elements.rend(), 0U);  // their order does not matter
  const RaySource source = areaRaySource(surfacePieces(scene, discretization), elements);
  for (const double x : {0.0, 0.2, 0.749, 0.751, 1.0}) {
    const ShootingPoint point = shootingPoint(source, x, 0.5);
    CHECK((point.triangle < 2) == (x < 0.75));
    const glm::dvec3 expected = x < 0.75 ? glm::dvec3(4 * x, 0.5, 0) : glm::dvec3(4 * x - 3, 0.5, 1);
    CHECK(glm::distance(point.position, inFrame(scene, expected)) < 1e-14);
  }
}

TEST_CASE("shootingPoint gives points with the centroid and the second moments of a triangle", "[raySource]") {
  // Over a triangle the mean of the weights is 1/3, that of their squares 1/6 and that of their products 1/12.
  const glm::dvec3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
  const std::vector<ShootingRange> one{{.upTo = 1, .begin = 0, .end = 1}};
  const RaySource raySource{one, one, one, {{{a, b}, {a, c}, {0, 1}, glm::normalize(glm::dvec3(1)), 0}}};
  CHECK(shootingPoint(raySource, 0, 0.5).position == a);
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
    const SurfacePoint middle = patchCentre(scene, discretization, discretization.patches.list[0]);
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
