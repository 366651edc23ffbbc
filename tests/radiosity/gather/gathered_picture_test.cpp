/// gatheredPicture: a white furnace, and the light of gathered texels.
#include "radiosity/gather/gathered_picture.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/textures/lit_scene.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

// In a closed room that emits E and reflects a share r everywhere, each point has the radiosity E / (1 - r). Linear
// values above 1 are kept, so that pixels are means of light.
TEST_CASE("gatheredPicture of a furnace shows the closed form at each pixel", "[gather]") {
  const glm::dvec3 reflected(0.5, 0.25, 0.75), emitted(0.5, 0.75, 0.25);
  const Scene scene = closedCube(reflected, emitted);
  const Light solved =
      light(scene, discretize(scene, {.texels = 4}), {.drawing = {.resolution = 64}, .solver = {.residual = 1e-5}});
  const GatheredPicture picture = gatheredPicture(scene, solved.discretization, solved.layout, solved.solution,
                                                  {{0.2, 0.3, 0.1}, {0.9, 0.6, 0.8}, {0, 1, 0}, 90}, 32, 24, 3);
  CHECK(picture.pixels == 32 * 24);
  CHECK(picture.drawn < picture.pixels);
  for (const glm::dvec3& pixel : picture.image.pixels)
    for (int band = 0; band < 3; ++band) CHECK(pixel[band] == Approx(3).epsilon(0.01));
}

TEST_CASE("gatheredPicture is the picture of gathered textures, but for their texels", "[gather]") {
  const Scene scene = loadScene(HEMITEX_DATA "/cornell-box.obj");
  const Light solved =
      light(scene, discretize(scene, {.texels = 4}), {.drawing = {.resolution = 64}, .solver = {.residual = 0.02}});
  const Camera camera{{278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 38};
  const double exposure = 1;
  const auto& [settings, discretization, layout, solution, captured, errors, ahead] = solved;
  const GatheredPicture picture = gatheredPicture(scene, discretization, layout, solution, camera, 40, 40, exposure);
  const TextureLayout textures = layOutTextures(scene, discretization, {8});
  const GatheredLight texels = *gather(scene, discretization, layout, textures, solution);
  const Image other =
      unlitPicture(makeLitScene(scene, discretization, textures,
                                codedTextures(radiosityTextures(scene, discretization, textures, texels), exposure)),
                   camera, 40, 40);
  double sum = 0, difference = 0, all = 0;
  int lampPixels = 0;
  for (std::size_t i = 0; i < other.pixels.size(); ++i) {
    // Pixels that show a part of the lamp are means of light here, and there of codes, which end at white.
    const glm::dvec3& pixel = picture.image.pixels[i];
    if (std::max({pixel.r, pixel.g, pixel.b}) > 1) {
      ++lampPixels;
      continue;
    }
    const glm::dvec3 more = pixel - other.pixels[i];
    sum += bandSum(more);
    difference += bandSum(glm::abs(more));
    all += bandSum(other.pixels[i]);
  }
  CHECK(lampPixels < 40);
  CHECK(std::abs(sum) < 0.01 * all);
  CHECK(difference < 0.03 * all);
}
