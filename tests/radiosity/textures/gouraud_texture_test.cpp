/// Elements as Gouraud shaded polygons in textures.
#include "radiosity/textures/gouraud_texture.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/texel_areas.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

TEST_CASE("shaded elements stay within half a texel of a linear field, whatever triangles the chart has", "[texture]") {
  // The bump's 5000 triangles cut every texel in many ways; elements hold the radiosity of their texels' middles.
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
      // Triangles' own corners inside a texel hold the element alone, so a texel's middle is flat; but no value is
      // further off than the slope over half a texel, and all are among their neighbours'.
      CHECK(std::abs(texel.x - place.x) <= 0.5 + 1e-12);
      CHECK(std::abs(texel.y - place.y) <= 0.5 + 1e-12);
      CHECK(texel.z == Approx(1).epsilon(1e-14));
    }
}

TEST_CASE("a texel that is cut but not covered at its centre shows what is cut of it", "[texture]") {
  // A triangle below the diagonal of 2 x 2 texels, its upper right texel left out; one texel wide slivers beside it.
  const Scene scene = sceneOf({flat("sliver", {{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 0.9)}})});
  const Discretization discretization = discretize(scene, {.texels = 4});
  const std::vector<glm::dvec3> values(discretization.elements.size(), glm::dvec3(3));
  const TexelAreas areas = texelAreas(scene.surfaces[0], texelGrid(discretization.grids[0]));
  const std::vector<glm::dvec3> texels = gouraudTexels(scene.surfaces[0], discretization.grids[0], values, 1);
  CHECK(std::any_of(areas.coverage.begin(), areas.coverage.end(), [](double c) { return c > 0 && c < 0.5; }));
  for (const glm::dvec3& texel : texels) CHECK(glm::distance(texel, glm::dvec3(3)) < 1e-14);
}
