// surfacePieces: the areas of pieces are those of elements, and index maps agree at all points.
#include "reference/truth/closed_forms/surface_pieces.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "reference/truth/rays/ray_caster.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex::reference;
using namespace hemitex::radiosity;
using namespace hemitex;

namespace {

double area(const SurfacePiece& piece) {
  glm::dvec3 doubled(0);
  for (std::size_t i = 2; i < piece.corner.size(); ++i)
    doubled += glm::cross(piece.corner[i - 1] - piece.corner[0], piece.corner[i] - piece.corner[0]);
  return 0.5 * glm::dot(doubled, piece.normal);
}

}  // namespace

// Corners are rounded to 1e-16 of the scene, and the longest element is as long as the scene.
TEST_CASE("surfacePieces give the pieces of an element its area", "[pieces]") {
  const Scene scene = tests::sceneOf(tests::tableOfSurfaces());
  const Discretization discretization = discretize(scene, {.texels = 7});
  const SurfacePieces pieces = surfacePieces(scene, discretization);
  REQUIRE(pieces.first.back() == pieces.pieces.size());
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    double sum = 0;
    for (const SurfacePiece& piece : pieces.of(e)) {
      CHECK(piece.element == e);
      sum += area(piece);
    }
    CHECK(sum * scene.extent * scene.extent == Approx(discretization.elements[e].area).epsilon(1e-11).margin(1e-15));
  }
}

TEST_CASE("elementAt each point of a piece is the piece's element", "[pieces]") {
  const Scene scene = tests::sceneOf(tests::tableOfSurfaces());
  const Discretization discretization = discretize(scene, {.texels = 7});
  const SurfacePieces pieces = surfacePieces(scene, discretization);
  int checked = 0;
  std::uint32_t first = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const auto count = static_cast<std::uint32_t>(scene.surfaces[s].triangles.size());
    for (const SurfacePiece& piece : pieces.pieces) {
      if (piece.triangle < first || piece.triangle >= first + count) continue;
      const Triangle& triangle = scene.surfaces[s].triangles[piece.triangle - first];
      // The middle of the corners, with weights by least squares over the triangle's edges.
      glm::dvec3 middle(0);
      for (const glm::dvec3& corner : piece.corner) middle += corner / double(piece.corner.size());
      const auto corner = inFrame(scene, triangle);
      const glm::dvec3 u = corner[1] - corner[0], v = corner[2] - corner[0], d = middle - corner[0];
      const glm::dvec3 n = glm::cross(u, v);
      const glm::dvec2 weights(glm::dot(glm::cross(d, v), n) / glm::dot(n, n),
                               glm::dot(glm::cross(u, d), n) / glm::dot(n, n));
      if (area(piece) < 1e-9) continue;  // thinner than the rounding error of those weights
      ++checked;
      CHECK(elementAt(triangle, discretization.grids[s], weights) == piece.element);
    }
    first += count;
  }
  CHECK(checked > 5000);
}
