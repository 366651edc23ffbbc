/// Material maps in display textures.
#include "radiosity/textures/map_texels.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A checkerboard of side x side pixels.
Image checkerboard(int side, const glm::dvec3& even, const glm::dvec3& odd) {
  Image image{side, side, {}};
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) image.pixels.push_back((row + column) % 2 == 0 ? even : odd);
  return image;
}

/// A square whose reflectance is the map, with `repeats` tiles along each side.
Scene mappedSquare(Image map, double repeats = 1) {
  Scene scene = tests::sceneOf({tests::parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  for (Triangle& triangle : scene.surfaces[0].triangles)
    for (int k = 0; k < 3; ++k) triangle.texcoord[k] = repeats * triangle.chart[k];
  scene.materials = {tests::material("tiles", glm::dvec3(1), glm::dvec3(0))};
  scene.materials[0].reflectanceMap = 0;
  scene.images = {std::move(map)};
  return scene;
}

/// The texels of the square of the columns x rows display texture under an irradiance of 1.
std::vector<glm::dvec3> litTexels(const Scene& scene, int columns, int rows) {
  std::vector<glm::dvec3> texels(static_cast<std::size_t>(columns * rows), glm::dvec3(1));
  applyMaps(scene, levelsOfMaps(scene), scene.surfaces[0], columns, rows, texels);
  return texels;
}

glm::dvec3 meanOf(const std::vector<glm::dvec3>& texels) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& texel : texels) sum += texel;
  return sum / static_cast<double>(texels.size());
}

}  // namespace

TEST_CASE("applyMaps shows each pixel of a map in its own texel", "[map-texels]") {
  // Rows of the texture count from v = 0, rows of the image from the top.
  const Image map = checkerboard(8, {0.9, 0.5, 0}, {0.1, 0, 0.3});
  const std::vector<glm::dvec3> texels = litTexels(mappedSquare(map), 8, 8);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column) {
      const glm::dvec3& pixel = map.pixels[static_cast<std::size_t>((7 - row) * 8 + column)];
      CHECK(glm::distance(texels[static_cast<std::size_t>(row * 8 + column)], pixel) < 1e-12);
    }
}

TEST_CASE("applyMaps shows the mean of a map whose pixels are smaller than texels", "[map-texels]") {
  for (const double repeats : {1.0, 4.0}) {
    const Scene scene = mappedSquare(checkerboard(64, glm::dvec3(1), glm::dvec3(0)), repeats);
    for (const glm::dvec3& texel : litTexels(scene, 8, 8)) CHECK(glm::distance(texel, glm::dvec3(0.5)) < 1e-12);
  }
}

TEST_CASE("applyMaps adds the emission of its map", "[map-texels]") {
  Scene scene = mappedSquare(checkerboard(4, glm::dvec3(1), glm::dvec3(0)));
  scene.materials[0].emission = {2, 3, 4};
  scene.materials[0].emissionMap = 0;
  for (const glm::dvec3& texel : litTexels(scene, 4, 4))
    CHECK((glm::length(texel) < 1e-12 || glm::distance(texel, {3, 4, 5}) < 1e-12));
}

TEST_CASE("makeLitScene shows a checkerboard finer than an element, and keeps the light of each element",
          "[map-texels]") {
  constexpr int side = 64;
  const Scene scene = mappedSquare(checkerboard(side, glm::dvec3(0.75), glm::dvec3(0.25)));
  const Discretization discretization = discretize(scene, {.texels = 2});
  const TextureLayout layout = layOutTextures(scene, discretization, {});
  REQUIRE(layout.textures[0].magnification * 2 >= side);
  // An irradiance of 1, which the elements reflect by the mean of the map.
  Solution solution;
  solution.radiosity.assign(4, glm::dvec3(0.5));
  solution.irradiance.assign(4, glm::dvec3(1));
  const std::vector<glm::dvec3> values = displayValues(scene, discretization, solution);
  const std::vector<ImageLevels> levels = levelsOfMaps(scene);
  const Image texture = filteredTexture(scene, discretization, layout, 0, values, TextureFilter::Bicubic, {}, &levels);
  const int times = layout.textures[0].magnification;
  std::vector<glm::dvec3> chart;
  double darkest = 1, brightest = 0;
  for (int row = times; row < 3 * times; ++row)
    for (int column = times; column < 3 * times; ++column) {
      chart.push_back(texture.pixels[static_cast<std::size_t>(row * texture.width + column)]);
      darkest = std::min(darkest, chart.back().r);
      brightest = std::max(brightest, chart.back().r);
    }
  CHECK(glm::distance(meanOf(chart), glm::dvec3(0.5)) < 1e-12);
  CHECK(darkest == Approx(0.25));
  CHECK(brightest == Approx(0.75));
}
