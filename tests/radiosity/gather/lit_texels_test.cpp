// texelsOf: normals of texels on curved surfaces.
#include "radiosity/gather/lit_texels.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "tests/support/ball.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

// Interpolated normals of facets 7 degrees wide are within 0.1 degrees of the ball's, also where charts meet.
TEST_CASE("texelsOf gives the texels of a ball normals that agree where its charts meet", "[gather]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "ball.obj") << tests::objText(tests::icosphere(3));
  const Scene scene = loadScene(folder.path / "ball.obj");
  const Discretization discretization = discretize(scene, {.texels = 8});
  double least = 1;
  for (const LitTexels& texels : texelsOf(scene, discretization, Magnifications(scene.surfaces.size(), 4)))
    for (const std::optional<LitPlace>& place : texels.places)
      if (place) least = std::min(least, glm::dot(place->point.normal, glm::normalize(place->point.position)));
  CHECK(least > 0.999998);
}
