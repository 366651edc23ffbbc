// mergedPieces: rectangles of many triangles become one polygon, with the same form factors.
#include "reference/truth/closed_forms/merged_pieces.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "reference/truth/closed_forms/scene_form_factors.h"
#include "tests/support/box_scene.h"
#include "tests/support/subdivided_scene.h"

using namespace hemitex::reference;
using namespace hemitex::radiosity;
using namespace hemitex;

namespace {

SurfacePieces wholePieces(const Scene& scene) { return surfacePieces(scene, discretize(scene, {.texels = 1})); }

/// A rectangle in the plane z = 0, in two triangles.
Surface rectangleSurface(double left, double right, double below, double above) {
  return tests::quad("a", {{{left, below, 0}, {right, below, 0}, {right, above, 0}, {left, above, 0}}});
}

/// A scene of one surface of the triangles of several.
Scene joined(const std::vector<Surface>& parts) {
  Scene scene;
  scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(0)));
  scene.surfaces = {parts.front()};
  for (std::size_t p = 1; p < parts.size(); ++p)
    for (const Triangle& triangle : parts[p].triangles) scene.surfaces[0].triangles.push_back(triangle);
  return tests::finish(std::move(scene));
}

std::size_t merged(const Scene& scene) { return mergedPieces(wholePieces(scene)).pieces.size(); }

}  // namespace

TEST_CASE("mergedPieces of a divided cube are its six squares, with the form factors of the whole cube",
          "[form factors]") {
  // In a frame whose coordinates are rounded.
  Scene cube = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  for (Surface& surface : cube.surfaces)
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& corner : triangle.position) corner = 0.3 * corner + glm::dvec3(0.1, 0.7, -0.3);
  cube = tests::finish(std::move(cube));
  const SurfacePieces whole = wholePieces(cube), divided = wholePieces(tests::finerScene(cube, 600)),
                      one = mergedPieces(divided);
  REQUIRE(divided.pieces.size() >= 600);
  REQUIRE(one.pieces.size() == 6);
  for (const SurfacePiece& piece : one.pieces) CHECK(piece.corner.size() == 4);
  for (std::uint32_t from = 0; from < 6; ++from) {
    const std::vector<double> expected = analyticRow(whole, std::vector{from}, whole),
                              row = analyticRow(one, std::vector{from}, one);
    for (std::size_t to = 0; to < 6; ++to) CHECK(row[to] == Approx(expected[to]).epsilon(1e-9));
  }
}

TEST_CASE("mergedPieces keeps pieces without one convex outline in one plane", "[form factors]") {
  const Surface square = rectangleSurface(0, 1, 0, 1);
  CHECK(merged(joined({square})) == 1);
  CHECK(merged(joined({square, rectangleSurface(1, 2, 0, 1)})) == 1);
  CHECK(merged(joined({square, rectangleSurface(1, 2, 0, 2)})) == 4);  // edges of other lengths
  CHECK(merged(joined({square, rectangleSurface(1, 2, 0, 1), rectangleSurface(0, 1, 1, 2)})) == 6);  // an L
  CHECK(merged(joined({square, rectangleSurface(2, 3, 0, 1)})) == 4);                                // two islands
  CHECK(merged(joined({square, rectangleSurface(1, 2, 1, 2)})) == 4);  // they meet at a corner
  CHECK(merged(joined({square, tests::quad("b", {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}})})) == 4);  // a fold
}
