/// Texture filters: properties of their kernels, and properties of all filters.
#include "radiosity/textures/texture_filter.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/random_quadtrees.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

constexpr TextureFilter smoothKernels[] = {TextureFilter::Triangle, TextureFilter::Bilinear, TextureFilter::Bicubic};
constexpr TextureFilter allFilters[] = {TextureFilter::OneToOne, TextureFilter::Triangle, TextureFilter::Bilinear,
                                        TextureFilter::Bicubic,  TextureFilter::Quadtree, TextureFilter::Gouraud};

Scene unitSquare() { return sceneOf({parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}); }

/// 2 + 3 x - y at places in [0, 1]^2.
glm::dvec3 linear(const glm::dvec2& place) { return {2 + 3 * place.x - place.y, 1, place.y}; }

std::vector<glm::dvec3> linearElements(const Scene& scene, const Discretization& discretization) {
  std::vector<glm::dvec3> values;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
    values.push_back(linear(glm::dvec2(elementCentre(scene, discretization, e).position)));
  return values;
}

std::vector<glm::dvec3> randomElements(const Discretization& discretization, std::mt19937& random) {
  std::vector<glm::dvec3> values;
  for (std::size_t e = 0; e < discretization.elements.size(); ++e)
    values.emplace_back(1 + random() % 1000, 1 + random() % 7, 1 + random() % 2);
  return values;
}

/// The largest distance from 2 + 3 x - y of texels that are `margin` texels of the grid away from the edges.
double distanceFromLinear(const std::vector<glm::dvec3>& texels, int side, int margin, int magnification) {
  double largest = 0;
  for (int j = margin * magnification; j < (side - margin) * magnification; ++j)
    for (int i = margin * magnification; i < (side - margin) * magnification; ++i) {
      const glm::dvec2 place = (glm::dvec2(i, j) + 0.5) / double(side * magnification);
      largest = std::max(largest, glm::distance(texels[std::size_t(j * side * magnification + i)], linear(place)));
    }
  return largest;
}

}  // namespace

TEST_CASE("kernelWeight is not negative, and the weights sum to 1 and have their place as mean", "[texture]") {
  for (int step = 0; step < 100; ++step) {
    const double place = -0.5 + step / 100.0;
    for (const TextureFilter filter : smoothKernels) {
      double sum = 0, mean = 0;
      for (int texel = -4; texel <= 4; ++texel) {
        const double weight = kernelWeight(filter, texel - place);
        CHECK(weight >= 0);
        sum += weight;
        mean += weight * texel;
      }
      CHECK(sum == Approx(1).epsilon(1e-14));
      CHECK(mean == Approx(place).margin(1e-14));
    }
  }
}

TEST_CASE("kernelWeight on texels is 1 and (1 2 1) and (1 4 1)", "[texture]") {
  CHECK(kernelWeight(TextureFilter::OneToOne, 0) == 1);
  CHECK(kernelWeight(TextureFilter::OneToOne, 1) == 0);
  CHECK(kernelWeight(TextureFilter::Triangle, 0) == 0.5);
  CHECK(kernelWeight(TextureFilter::Triangle, -1) == 0.25);
  CHECK(kernelWeight(TextureFilter::Triangle, 2) == 0);
  CHECK(kernelWeight(TextureFilter::Bilinear, 0) == 1);
  CHECK(kernelWeight(TextureFilter::Bilinear, -1) == 0);
  CHECK(kernelWeight(TextureFilter::Bicubic, 0) == Approx(4.0 / 6).epsilon(1e-15));
  CHECK(kernelWeight(TextureFilter::Bicubic, 1) == Approx(1.0 / 6).epsilon(1e-15));
  CHECK(kernelWeight(TextureFilter::Bicubic, -2) == 0);
}

TEST_CASE("filteredTexels keep linear fields away from edges, also magnified", "[texture]") {
  const Scene scene = unitSquare();
  const Discretization discretization = discretize(scene, {.texels = 9});
  const std::vector<glm::dvec3> values = linearElements(scene, discretization);
  for (const TextureFilter filter : allFilters) {
    if (filter == TextureFilter::OneToOne) continue;
    for (const int times : {1, 2, 3, 4}) {
      INFO("filter " << int(filter) << " times " << times);
      const std::vector<glm::dvec3> texels = filteredTexels(scene, discretization, 0, values, filter, times);
      REQUIRE(texels.size() == std::size_t(81 * times * times));
      CHECK(distanceFromLinear(texels, 9, 2, times) < 1e-14);
    }
  }
}

TEST_CASE("filteredTexels with one-to-one repeat elements, and with bilinear are the same without magnification",
          "[texture]") {
  const Scene scene = sceneOf({lShape()});
  const Discretization discretization = discretize(scene, {.texels = 10});
  std::mt19937 random(1);
  const std::vector<glm::dvec3> values = randomElements(discretization, random);
  const auto oneToOne = filteredTexels(scene, discretization, 0, values, TextureFilter::OneToOne, 3);
  for (std::size_t j = 0; j < 30; ++j)
    for (std::size_t i = 0; i < 30; ++i)
      CHECK(oneToOne[j * 30 + i] == values[discretization.grids[0].elementOfTexel[j / 3 * 10 + i / 3]]);
  CHECK(filteredTexels(scene, discretization, 0, values, TextureFilter::Bilinear, 1) ==
        filteredTexels(scene, discretization, 0, values, TextureFilter::OneToOne, 1));
}

TEST_CASE("filteredTexels with all filters keep constants and write every texel, on holes, slivers and quadtrees",
          "[texture]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  std::mt19937 random(2);
  std::vector<Quadtree> trees;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) trees.push_back(randomBalancedQuadtree(16, random));
  const glm::dvec3 constant(0.1, 7, 1e20);
  for (const Discretization& discretization :
       {discretize(scene, {.texels = 13}), discretize(scene, {.texels = 16}, trees)}) {
    const std::vector<glm::dvec3> constants(discretization.elements.size(), constant);
    const std::vector<glm::dvec3> values = randomElements(discretization, random);
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
      for (const TextureFilter filter : allFilters) {
        INFO(scene.surfaces[s].name << " by filter " << int(filter));
        const int times = 1 + int(random() % 4);
        for (const glm::dvec3& texel : filteredTexels(scene, discretization, s, constants, filter, times))
          REQUIRE(glm::all(glm::lessThanEqual(glm::abs(texel - constant), 1e-13 * constant)));
        // Means stay in the range of the values. A quadtree's edges may be extrapolated beyond, but not below 0.
        const double least = filter == TextureFilter::Quadtree ? 0 : 1 - 1e-13;
        const double most = filter == TextureFilter::Quadtree ? 2000 : 1000 + 1e-10;
        for (const glm::dvec3& texel : filteredTexels(scene, discretization, s, values, filter, times))
          REQUIRE((texel.x >= least && texel.x <= most));
      }
  }
}
