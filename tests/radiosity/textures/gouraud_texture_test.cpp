/// gouraudTexels: elements as Gouraud shaded polygons in textures.
#include "radiosity/textures/gouraud_texture.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/texel_areas.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

TEST_CASE("gouraudTexels stay within half a texel of a linear field, for any triangles of the chart", "[texture]") {
  // The bump's 5000 triangles cut each texel in many ways; elements have the radiosity of the middles of their texels.
  const Scene scene = sceneOf({bump(50)});
  const Discretization discretization = discretize(scene, {.texels = 8});
  std::vector<glm::dvec3> values;
  for (const Element& element : discretization.elements)
    values.emplace_back(element.texel % 8 + 0.5, element.texel / 8 + 0.5, 1);
  constexpr int times = 8;
  const std::vector<glm::dvec3> texels = gouraudTexels(scene.surfaces[0], discretization.grids[0], values, times);
  for (int j = 0; j < 8 * times; ++j)
    for (int i = 0; i < 8 * times; ++i) {
      const glm::dvec3& texel = texels[std::size_t(j * 8 * times + i)];
      const glm::dvec2 place = (glm::dvec2(i, j) + 0.5) / double(times);
      // Corners of triangles inside a texel have the value of its element alone, so that the middle of a texel is flat.
      // The error of a value is at most the slope over half a texel, and all are in the range of their neighbours.
      CHECK(std::abs(texel.x - place.x) <= 0.5 + 1e-12);
      CHECK(std::abs(texel.y - place.y) <= 0.5 + 1e-12);
      CHECK(texel.z == Approx(1).epsilon(1e-14));
    }
}

TEST_CASE("gouraudTexels of a texel not covered at its centre show its covered part", "[texture]") {
  // A triangle below the diagonal of 2 x 2 texels without the upper right texel, and slivers one texel wide beside it.
  const Scene scene = sceneOf({flat("sliver", {{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 0.9)}})});
  const Discretization discretization = discretize(scene, {.texels = 4});
  const std::vector<glm::dvec3> values(discretization.elements.size(), glm::dvec3(3));
  const TexelAreas areas = texelAreas(scene.surfaces[0], texelGrid(discretization.grids[0]));
  const std::vector<glm::dvec3> texels = gouraudTexels(scene.surfaces[0], discretization.grids[0], values, 1);
  CHECK(std::any_of(areas.coverage.begin(), areas.coverage.end(), [](double c) { return c > 0 && c < 0.5; }));
  for (const glm::dvec3& texel : texels) CHECK(glm::distance(texel, glm::dvec3(3)) < 1e-14);
}
