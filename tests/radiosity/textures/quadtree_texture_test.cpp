/// quadtreeTexels: exact for linear fields, continuous over leaves of any size.
#include "radiosity/textures/quadtree_texture.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/textures/texture_filter.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/random_quadtrees.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

constexpr int side = 16;

Scene square() { return sceneOf({parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}); }

Discretization randomLeaves(const Scene& scene, std::mt19937& random) {
  return discretize(scene, {.texels = side}, {randomBalancedQuadtree(side, random)});
}

std::vector<glm::dvec3> texelsOf(const Discretization& discretization, const std::vector<glm::dvec3>& values,
                                 int magnification) {
  return quadtreeTexels(discretization, discretization.grids[0], values, magnification);
}

}  // namespace

TEST_CASE("quadtreeTexels reproduce a linear field at each texel, over any balanced quadtree", "[texture]") {
  const Scene scene = square();
  std::mt19937 random(1);
  const auto linear = [](const glm::dvec2& place) { return glm::dvec3(2 + 3 * place.x - place.y, place.x, 5); };
  for (int round = 0; round < 30; ++round) {
    const Discretization discretization = randomLeaves(scene, random);
    if (discretization.elements.size() == 1) continue;  // has no slope
    std::vector<glm::dvec3> values;
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
      values.push_back(linear(glm::dvec2(elementCentre(scene, discretization, e).position)));
    const int times = 1 + round % 3, texels = side * times;
    const std::vector<glm::dvec3> texture = texelsOf(discretization, values, times);
    for (int j = 0; j < texels; ++j)
      for (int i = 0; i < texels; ++i)
        REQUIRE(glm::distance(texture[std::size_t(j * texels + i)], linear((glm::dvec2(i, j) + 0.5) / double(texels))) <
                1e-13);
  }
}

TEST_CASE("quadtreeTexels of adjacent texels differ by no more than the slopes between corners, also across leaves",
          "[texture]") {
  // Elements have values up to 1, and corners inside the chart are means of them. Corners on its edge are extrapolated
  // by at most the same distance again, to values from 0 to 2. No leaf is smaller than a texel of the grid. So over a
  // texel the texture changes by at most 2 along each axis, and by 2 / 16 between texels 16 times as fine.
  const Scene scene = square();
  std::mt19937 random(2);
  constexpr int times = 16, texels = side * times;
  double largest = 0;
  for (int round = 0; round < 10; ++round) {
    const Discretization discretization = randomLeaves(scene, random);
    std::vector<glm::dvec3> values;
    for (std::size_t e = 0; e < discretization.elements.size(); ++e) values.emplace_back(random() % 2);
    const std::vector<glm::dvec3> texture = texelsOf(discretization, values, times);
    for (int j = 0; j < texels; ++j)
      for (int i = 0; i < texels; ++i) {
        const double value = texture[std::size_t(j * texels + i)].x;
        REQUIRE((value >= 0 && value <= 2));
        if (i > 0) largest = std::max(largest, std::abs(value - texture[std::size_t(j * texels + i - 1)].x));
        if (j > 0) largest = std::max(largest, std::abs(value - texture[std::size_t((j - 1) * texels + i)].x));
      }
  }
  CHECK(largest <= 2.0 / times + 1e-14);
  CHECK(largest > 0.5 / times);
}

TEST_CASE("quadtreeTexels over single texels equal the triangle filter, except at edges", "[texture]") {
  const Scene scene = square();
  const Discretization discretization = discretize(scene, {.texels = side});
  std::mt19937 random(3);
  std::vector<glm::dvec3> values;
  for (int e = 0; e < side * side; ++e) values.emplace_back(random() % 100, 1, 0);
  const std::vector<glm::dvec3> flattened = texelsOf(discretization, values, 1);
  const std::vector<glm::dvec3> filtered = filteredTexels(scene, discretization, 0, values, TextureFilter::Triangle, 1);
  for (int j = 1; j < side - 1; ++j)
    for (int i = 1; i < side - 1; ++i)
      CHECK(glm::distance(flattened[std::size_t(j * side + i)], filtered[std::size_t(j * side + i)]) < 1e-12);
}
