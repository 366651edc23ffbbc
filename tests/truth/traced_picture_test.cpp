// tracedPicture compared with closed forms.
#include "tests/truth/traced_picture.h"

#include <catch2/catch.hpp>

#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

TEST_CASE("A path-traced furnace shows its radiosity in every pixel", "[traced-picture]") {
  // A closed room that emits 1 and reflects 0.5 everywhere has the radiosity 1 / (1 - 0.5).
  Scene scene = sceneOf(box("room", {0, 0, 0}, {4, 3, 2}, true));
  scene.materials = {material("grey", glm::dvec3(0.5), glm::dvec3(1))};
  const Image picture = tracedPicture(scene, {{1, 1, 1}, {4, 2, 1.3}, {0, 0, 1}, 70}, 24, 16, 16);
  glm::dvec3 sum(0);
  for (const glm::dvec3& pixel : picture.pixels) {
    CHECK(pixel.g == Approx(2).margin(.35));  // 256 paths, each off by about 1
    sum += pixel;
  }
  CHECK(sum.g / static_cast<double>(picture.pixels.size()) == Approx(2).margin(.01));
}

TEST_CASE("A path-traced floor under a lamp has the light of the closed form", "[traced-picture]") {
  // A black lamp of 1 m x 1 m at a height of 1 m, as large as the part of the floor that the camera shows.
  Scene scene = sceneOf({parallelogram("floor", {-1, -1, 0}, {3, 0, 0}, {0, 3, 0}),
                         quad("lamp", {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}, 1)});
  scene.materials = {material("grey", glm::dvec3(0.5), glm::dvec3(0)), material("light", glm::dvec3(0), {1, 2, 4})};
  // From above, through the back of the lamp: 2 atan(0.5 / 10) degrees show the unit square.
  const SceneCamera camera{{.5, .5, 10}, {.5, .5, 0}, {0, 1, 0}, 5.724810452};
  const Image picture = tracedPicture(scene, camera, 8, 8, 32);
  glm::dvec3 mean(0);
  for (const glm::dvec3& pixel : picture.pixels) mean += pixel / 64.0;
  // Two opposite unit squares one unit apart: F = 0.19982 (Howell, C-11).
  for (int band = 0; band < 3; ++band) CHECK(mean[band] == Approx(.5 * .199825 * (1 << band)).epsilon(2e-3));
  // Lamps and rays find the same light: half as bright a floor shows half of it.
  CHECK(differenceOf(picture, picture).mean == 0);
}

TEST_CASE("The difference of pictures is that of their 8-bit codes", "[traced-picture]") {
  Image a{10, 10, std::vector<glm::dvec3>(100, glm::dvec3(decodeSrgb(.2)))}, b = a;
  b.pixels[3] = glm::dvec3(decodeSrgb(.4));
  CHECK(differenceOf(a, b).mean == Approx(.2 / 100));
  CHECK(differenceOf(a, b).of99Percent == Approx(.2));
  b.pixels[4] = glm::dvec3(7);  // clamped to 1
  CHECK(differenceOf(a, b).of99Percent == Approx(.8));
}
