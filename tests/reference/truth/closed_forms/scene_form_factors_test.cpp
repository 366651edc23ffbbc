// analyticRow on a cube, where all form factors are known.
#include "reference/truth/closed_forms/scene_form_factors.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "reference/truth/rays/ray_source.h"
#include "tests/support/box_scene.h"
#include "tests/support/form_factor_quadrature.h"
#include "tests/truth/rectangles.h"

using namespace hemitex::reference;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

constexpr std::uint32_t floorSurface = 2, ceilingSurface = 3;
constexpr int texels = 4;

/// A cube; each face is a surface of one element, and of several.
struct Cube {
  Scene scene = closedCube(glm::dvec3(0.5), glm::dvec3(1));
  Discretization whole = discretize(scene, {.texels = 1}), fine = discretize(scene, {.texels = texels});
  SurfacePieces wholePieces = surfacePieces(scene, whole), finePieces = surfacePieces(scene, fine);
};

/// A texel of the floor, whose chart runs along z and then x, or of the ceiling, along x and then z; as (x, z).
AxisRectangle texelOf(std::uint32_t surface, std::uint32_t texel) {
  const double step = 1.0 / texels, u = texel % texels * step, v = texel / texels * step;
  if (surface == floorSurface) return {{v, v + step}, {u, u + step}};
  return {{u, u + step}, {v, v + step}};
}

}  // namespace

TEST_CASE("analyticRow of a surface of a cube equals the closed forms", "[form factors]") {
  const Cube cube;
  const std::vector<std::uint32_t> from = elementsOfSurface(cube.whole, floorSurface);
  const std::vector<double> row = analyticRow(cube.wholePieces, from, cube.finePieces);
  REQUIRE(row.size() == cube.fine.elements.size());
  CHECK(std::abs(std::accumulate(row.begin(), row.end(), 0.0) - 1) < 1e-10);
  const AxisRectangle all{{0, 1}, {0, 1}};
  for (std::uint32_t e = 0; e < row.size(); ++e) {
    const Element& element = cube.fine.elements[e];
    if (element.surface == floorSurface) CHECK(row[e] == 0);
    if (element.surface == ceilingSurface)
      CHECK(relativeError(row[e], parallelRectangles(all, texelOf(ceilingSurface, element.texel), 1)) < 1e-10);
  }
}

TEST_CASE("analyticRow of an element of a cube to the other surfaces sums to 1", "[form factors]") {
  const Cube cube;
  for (const std::uint32_t surface : {floorSurface, ceilingSurface})
    for (const std::uint32_t from : elementsOfSurface(cube.fine, surface)) {
      const std::vector<double> row = analyticRow(cube.finePieces, std::vector{from}, cube.wholePieces);
      CHECK(std::abs(std::accumulate(row.begin(), row.end(), 0.0) - 1) < 1e-10);
      const double expected = parallelRectangles(texelOf(surface, cube.fine.elements[from].texel), {{0, 1}, {0, 1}}, 1);
      CHECK(relativeError(row[surface == floorSurface ? ceilingSurface : floorSurface], expected) < 1e-10);
    }
}

TEST_CASE("analyticRow of several elements is the mean of their rows", "[form factors]") {
  const Cube cube;
  const std::vector<std::uint32_t> from = elementsOfSurface(cube.fine, floorSurface);
  const std::vector<double> together =
      analyticRow(cube.wholePieces, elementsOfSurface(cube.whole, floorSurface), cube.wholePieces);
  std::vector<double> mean(together.size(), 0.0);
  for (const std::uint32_t element : from) {
    const std::vector<double> alone = analyticRow(cube.finePieces, std::vector{element}, cube.wholePieces);
    for (std::size_t to = 0; to < mean.size(); ++to) mean[to] += alone[to] / double(from.size());
  }
  for (std::size_t to = 0; to < mean.size(); ++to) CHECK(std::abs(mean[to] - together[to]) < 1e-10);
}
