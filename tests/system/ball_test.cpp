// A diffuse ball of facets beside a shining wall, at the default settings, compared with the closed form of a sphere.
#include "tests/support/ball.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/chart_borders.h"
#include "radiosity/textures/texture_filter.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr double reflected = 0.5;
const std::array<glm::dvec3, 4> wall{{{-2, -3, -3}, {-2, 3, -3}, {-2, 3, 3}, {-2, -3, 3}}};

/// A unit ball of 1,280 facets at the origin, and a black wall that emits 1 W/m^2.
Scene ballBesideWall() {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "ball.mtl") << "newmtl ball\nKd .5 .5 .5\nnewmtl wall\nKd 0 0 0\nKe 1 1 1\n";
  std::ofstream(folder.path / "ball.obj") << "mtllib ball.mtl\no wall\nusemtl wall\n"
                                             "v -2 -3 -3\nv -2 3 -3\nv -2 3 3\nv -2 -3 3\nf 1 2 3 4\n"
                                             "o ball\nusemtl ball\n"
                                          << tests::objText(tests::icosphere(3));
  return loadScene(folder.path / "ball.obj");
}

/// The display texture of a surface, with `times` texels along the side of a grid texel.
std::vector<glm::dvec3> shown(const Scene& scene, const Discretization& discretization,
                              const std::vector<glm::dvec3>& radiosity, std::uint32_t surface, int times,
                              const std::vector<BorderEdge>& edges) {
  constexpr TextureFilter filter = TextureFilter::Bicubic;
  std::vector<glm::dvec3> texels = filteredTexels(scene, discretization, surface, radiosity, filter, times);
  correctBorders(discretization.grids[surface], radiosity, filter, times, edges, texels);
  return texels;
}

}  // namespace

// The ball does not see itself, and the wall reflects nothing: the radiosity of a point of the ball is its reflectance
// times the form factor to the wall (Lambert), at the sphere's normal. The texture is compared in the middle of each
// facet. The mean error is at most 1 % of the mean radiosity; what the ball receives in all is right within .5 %.
TEST_CASE("solve of a ball beside a wall shows no facets: the closed form of a sphere within 1 % of the mean",
          "[ball]") {
  const Scene scene = ballBesideWall();
  CHECK(scene.surfaces.size() <= 12);
  const Discretization discretization = discretize(scene, {});
  SceneFormFactors drawn(scene, discretization, layOut(discretization), {});
  const Solution solution = solve({.scene = scene,
                                   .discretization = discretization,
                                   .patches = discretization.patches,
                                   .rowOf = drawn.rowOf(),
                                   .split = drawn.splits()});
  const auto borders = borderEdges(scene, discretization, solution.radiosity, TextureFilter::Bicubic);
  constexpr int times = 8;
  double error = 0, found = 0, expected = 0;
  for (std::uint32_t s = 1; s < scene.surfaces.size(); ++s) {
    const Grid& grid = discretization.grids[s];
    const std::vector<glm::dvec3> texels = shown(scene, discretization, solution.radiosity, s, times, borders[s]);
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      const glm::dvec2 place = (triangle.chart[0] + triangle.chart[1] + triangle.chart[2]) / 3.0 *
                               glm::dvec2(grid.columns * times, grid.rows * times);
      const auto texel = static_cast<std::size_t>(place.y) * static_cast<std::size_t>(grid.columns * times) +
                         static_cast<std::size_t>(place.x);
      const glm::dvec3 outwards = glm::normalize(triangle.position[0] + triangle.position[1] + triangle.position[2]);
      const double truth = reflected * reference::pointToPolygon(outwards, outwards, wall), weight = area(triangle);
      error += weight * std::abs(texels[texel].x - truth);
      found += weight * texels[texel].x;
      expected += weight * truth;
    }
  }
  CHECK(error < 0.01 * expected);
  CHECK(found == Approx(expected).epsilon(0.005));
}
