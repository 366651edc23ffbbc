// borderEdges and correctBorders: display textures of a ball's charts agree where the charts meet.
#include "radiosity/textures/chart_borders.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <tuple>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/scene/load_scene.h"
#include "tests/support/ball.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

struct Ball {
  Scene scene;
  Discretization discretization;

  explicit Ball(int texels) {
    const TemporaryFolder folder;
    std::ofstream(folder.path / "ball.obj") << tests::objText(tests::icosphere(3));
    scene = loadScene(folder.path / "ball.obj");
    discretization = discretize(scene, {.texels = texels});
  }

  /// A value of each element: the mean of 2 + x over it, but for second-order terms.
  std::vector<glm::dvec3> linearField() const {
    std::vector<glm::dvec3> values;
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
      values.emplace_back(2 + elementCentre(scene, discretization, e).position.x);
    return values;
  }
};

/// The largest difference between charts at a common vertex. Textures have one value per texel of size 1 / times.
double largestJump(const Ball& ball, const std::vector<std::vector<glm::dvec3>>& textures, int times) {
  std::map<std::tuple<double, double, double>, std::pair<double, double>> range;
  for (std::size_t s = 0; s < textures.size(); ++s) {
    const Grid& grid = ball.discretization.grids[s];
    for (const Triangle& triangle : ball.scene.surfaces[s].triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 place = triangle.chart[k] * glm::dvec2(grid.columns * times, grid.rows * times);
        const int i = std::min(static_cast<int>(place.x), grid.columns * times - 1),
                  j = std::min(static_cast<int>(place.y), grid.rows * times - 1);
        const double value = textures[s][static_cast<std::size_t>(j * grid.columns * times + i)].x;
        const glm::dvec3 p = triangle.position[k];
        const auto [found, isNew] = range.try_emplace({p.x, p.y, p.z}, value, value);
        found->second = {std::min(found->second.first, value), std::max(found->second.second, value)};
      }
    }
  }
  double largest = 0;
  for (const auto& [position, ends] : range) largest = std::max(largest, ends.second - ends.first);
  return largest;
}

}  // namespace

// The texture has a value per 1/32 texel of the grid, an eighth of the ball's radius. The field changes by at most its
// gradient times the stretch of 2 over that: 1/8 * 1/32 * 2 * sqrt(2) = .011.
TEST_CASE("correctBorders makes the textures of a ball's charts agree where they meet", "[texture]") {
  const Ball ball(16);
  const std::vector<glm::dvec3> values = ball.linearField();
  constexpr TextureFilter filter = TextureFilter::Bicubic;
  const auto edges = borderEdges(ball.scene, ball.discretization, values, filter);
  std::vector<std::vector<glm::dvec3>> textures;
  for (std::uint32_t s = 0; s < ball.scene.surfaces.size(); ++s)
    textures.push_back(filteredTexels(ball.scene, ball.discretization, s, values, filter, 32));
  CHECK(largestJump(ball, textures, 32) > 0.05);
  for (std::uint32_t s = 0; s < ball.scene.surfaces.size(); ++s) {
    REQUIRE_FALSE(edges[s].empty());
    correctBorders(ball.discretization.grids[s], values, filter, 32, edges[s], textures[s]);
  }
  CHECK(largestJump(ball, textures, 32) < 0.011);
}

TEST_CASE("borderEdges of equal values correct nothing; filters without a kernel have none", "[texture]") {
  const Ball ball(8);
  const std::vector<glm::dvec3> ones(ball.discretization.elements.size(), glm::dvec3(1));
  for (const std::vector<BorderEdge>& edges :
       borderEdges(ball.scene, ball.discretization, ones, TextureFilter::Bicubic))
    for (const BorderEdge& edge : edges)
      for (const glm::dvec3& correction : edge.correction) CHECK(glm::length(correction) < 1e-14);
  for (const std::vector<BorderEdge>& edges :
       borderEdges(ball.scene, ball.discretization, ones, TextureFilter::Gouraud))
    CHECK(edges.empty());
}

// The facets of the ball are 7 degrees wide, and so are the elements: the mean normal of an element lies within half of
// both of the direction to its centre.
TEST_CASE("meanNormals of a ball point away from its centre, and elementPlaces have them", "[centres]") {
  const Ball ball(16);
  const auto placeOf = elementPlaces(ball.scene, ball.discretization);
  for (std::uint32_t s = 0; s < ball.scene.surfaces.size(); ++s) {
    const Grid& grid = ball.discretization.grids[s];
    const std::vector<glm::dvec3> normals = meanNormals(ball.scene.surfaces[s], grid);
    REQUIRE(normals.size() == grid.elementCount);
    for (const std::uint32_t e : elementsOf(grid)) {
      const glm::dvec3 centre = elementCentre(ball.scene, ball.discretization, e).position;
      CHECK(glm::length(normals[e - grid.firstElement]) == Approx(1));
      CHECK(glm::dot(normals[e - grid.firstElement], glm::normalize(centre)) > 0.985);
      CHECK(placeOf(e).position == centre);
      CHECK(placeOf(e).normal == normals[e - grid.firstElement]);
    }
  }
}
