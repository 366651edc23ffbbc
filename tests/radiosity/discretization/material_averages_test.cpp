// meansOfMap integrates pixels exactly for all discretizations.
#include "radiosity/discretization/material_averages.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

Image randomImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&] { return double(random()) / 4294967296.0; };
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.pixels.push_back({draw(), draw(), draw()});
  return image;
}

glm::dvec3 meanOf(const Image& image) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& pixel : image.pixels) sum += pixel;
  return sum / double(image.pixels.size());
}

/// A scene of one surface with the image as its map, under a white emitter.
Scene shownOn(Surface surface, Image image) {
  Scene scene = sceneOf({std::move(surface)});
  scene.materials[0].emission = glm::dvec3(1);
  scene.materials[0].emissionMap = 0;
  scene.images = {std::move(image)};
  return scene;
}

std::vector<glm::dvec3> averages(const Scene& scene, int texels) {
  return discretize(scene, {.texels = texels}).mappedEmission;
}

/// The flux of all elements: the sum of emission times area.
glm::dvec3 flux(const Scene& scene, int texels) {
  const Discretization discretization = discretize(scene, {.texels = texels});
  glm::dvec3 sum(0);
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
    sum += discretization.elements[e].area * emission(scene, discretization, e);
  return sum;
}

void scaleTexcoords(Surface& surface, const glm::dvec2& scale, const glm::dvec2& offset) {
  for (Triangle& triangle : surface.triangles)
    for (glm::dvec2& texcoord : triangle.texcoord) texcoord = texcoord * scale + offset;
}

bool areClose(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  return glm::length(a - b) <= tolerance * glm::length(b);
}

const std::array<glm::dvec3, 4> squareCorners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

}  // namespace

TEST_CASE("meansOfMap multiplies an image by the colours of corners: the mean of both over an element", "[maps]") {
  Scene scene = sceneOf({parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  Surface& surface = scene.surfaces[0];
  surface.hasColours = true;
  // The colour is u, and the image is black for u below a half: the mean of u over the right half is 3/8.
  for (Triangle& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.texcoord[k] = triangle.chart[k];
      triangle.colour[k] = glm::vec3(static_cast<float>(triangle.chart[k].x), 1, 0);
    }
  const auto means = [&](int texels) { return discretize(scene, {.texels = texels}).mappedReflectance; };
  const glm::dvec3 factor = scene.materials[0].reflectance;
  CHECK(areClose(means(1)[0], factor * glm::dvec3(0.5, 1, 0), 1e-12));
  CHECK(areClose(means(2)[1], factor * glm::dvec3(0.75, 1, 0), 1e-12));
  scene.materials[0].reflectanceMap = 0;
  scene.images = {Image{2, 1, {glm::dvec3(0), glm::dvec3(1)}}};
  CHECK(areClose(means(1)[0], factor * glm::dvec3(0.375, 0.5, 0), 1e-12));
  CHECK(areClose(means(4)[2], factor * glm::dvec3(0.625, 1, 0), 1e-12));
}

TEST_CASE("meansOfMap clamps, mirrors and moves texture coordinates as the sampler says", "[maps]") {
  const auto meanAt = [](const glm::dvec2& low, const glm::dvec2& high, const Sampler& sampler) {
    Surface surface = parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (Triangle& triangle : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) triangle.texcoord[k] = low + triangle.chart[k] * (high - low);
    return averages(shownOn(surface, {2, 1, {glm::dvec3(0), glm::dvec3(1)}, sampler}), 1)[0].x;
  };
  const Sampler clamp{.wrap = {Wrap::Clamp, Wrap::Clamp}}, mirror{.wrap = {Wrap::Mirror, Wrap::Mirror}};
  CHECK(meanAt({0, 0}, {4, 4}, clamp) == Approx(0.875));
  CHECK(meanAt({-3, -3}, {1, 1}, clamp) == Approx(0.125));
  CHECK(meanAt({1e15, 0}, {1e15 + 4, 1}, clamp) == Approx(1));
  CHECK(meanAt({1.5, 0}, {2.5, 1}, mirror) == Approx(0).margin(1e-12));
  CHECK(meanAt({1000000.5, 0}, {1000001.5, 1}, mirror) == Approx(1));
  CHECK(meanAt({-0.5, 0}, {0.5, 1}, mirror) == Approx(0).margin(1e-12));
  CHECK(meanAt({0.5, 0}, {1.5, 1}, {}) == Approx(0.5));
  Sampler moved;
  moved.place = {0.5, 0, 0, 1, 0.5, 0};
  CHECK(meanAt({0, 0}, {1, 1}, moved) == Approx(1));
}

TEST_CASE("meansOfMap of an image with one pixel per texel gives each element its pixel, top row at v = 1", "[maps]") {
  const Image image = randomImage(5, 5, 1);
  const std::vector<glm::dvec3> mean = averages(shownOn(quad("q", squareCorners), image), 5);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      CHECK(areClose(mean[std::size_t(row * 5 + column)], image.pixels[std::size_t((4 - row) * 5 + column)], 1e-14));
}

TEST_CASE("meansOfMap splits an element by area at a pixel's border", "[maps]") {
  // Three columns of pixels, 0, 3 and 9, over two elements: 2/3 of 0 and 1/3 of 3; 1/3 of 3 and 2/3 of 9.
  const Image image{3, 1, {glm::dvec3(0), glm::dvec3(3), glm::dvec3(9)}};
  const std::vector<glm::dvec3> mean = averages(shownOn(quad("q", squareCorners), image), 2);
  for (const std::size_t row : {std::size_t{0}, std::size_t{2}}) {
    CHECK(mean[row].x == Approx(1).epsilon(1e-14));
    CHECK(mean[row + 1].x == Approx(7).epsilon(1e-14));
  }
}

TEST_CASE("meansOfMap keeps the flux of a painted light at all discretizations", "[maps]") {
  for (const Surface& surface : tableOfSurfaces()) {
    Scene scene = shownOn(surface, randomImage(37, 23, 2));
    const glm::dvec3 whole = flux(scene, 1);
    for (const int texels : {2, 5, 16, 61}) {
      INFO(surface.name << " with " << texels << " texels");
      CHECK(areClose(flux(scene, texels), whole, 1e-12));
    }
  }
}

TEST_CASE("meansOfMap does not miss a single bright pixel of a large image", "[maps]") {
  Image image{512, 512, std::vector<glm::dvec3>(std::size_t{512} * 512)};
  image.pixels[100 * 512 + 300] = glm::dvec3(512.0 * 512.0);
  CHECK(areClose(flux(shownOn(quad("q", squareCorners), image), 4), glm::dvec3(1), 1e-12));
}

TEST_CASE("meansOfMap repeats textures: coordinates moved by whole tiles show the same", "[maps]") {
  const Image image = randomImage(8, 5, 3);
  Surface moved = bump(4);
  scaleTexcoords(moved, {1, 1}, {-3, 0x1p40});  // the coordinates are quarters, so that nothing is rounded
  const std::vector<glm::dvec3> here = averages(shownOn(bump(4), image), 6);
  const std::vector<glm::dvec3> there = averages(shownOn(moved, image), 6);
  for (std::size_t e = 0; e < here.size(); ++e) CHECK(areClose(there[e], here[e], 1e-13));
}

TEST_CASE("meansOfMap of a tiled image gives its mean over elements of whole tiles, for any number of tiles",
          "[maps]") {
  // Up to 1e9 x 1e9 tiles: the image is halved to a single pixel before that many are clipped.
  const Image image = randomImage(6, 5, 4);
  for (const double tiles : {4.0, 400.0, 4000.0, 1e9}) {
    Surface surface = quad("q", squareCorners);
    scaleTexcoords(surface, {tiles, tiles}, {0, 0});
    INFO(tiles << " tiles");
    for (const glm::dvec3& mean : averages(shownOn(surface, image), 2)) CHECK(areClose(mean, meanOf(image), 1e-9));
  }
}

TEST_CASE("halved keeps the mean of an image, and averages pairs of pixels for even sizes", "[maps]") {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 7}, {64, 3}, {9, 31}}) {
    const Image image = randomImage(width, height, 5);
    const Image half = halved(image);
    CHECK(half.width == (width + 1) / 2);
    CHECK(half.height == (height + 1) / 2);
    CHECK(areClose(meanOf(half), meanOf(image), 1e-13));
  }
  const Image pairs{4, 1, {glm::dvec3(1), glm::dvec3(3), glm::dvec3(10), glm::dvec3(20)}};
  CHECK(halved(pairs).pixels == std::vector<glm::dvec3>{glm::dvec3(2), glm::dvec3(15)});
  // Three pixels become two of one and a half: (1 + 3/2) / 1.5 and (3/2 + 10) / 1.5.
  const Image three{3, 1, {glm::dvec3(1), glm::dvec3(3), glm::dvec3(10)}};
  CHECK(halved(three).pixels[0].x == Approx(2.5 / 1.5));
  CHECK(halved(three).pixels[1].x == Approx(11.5 / 1.5));
}

TEST_CASE("averageMaps multiplies a reflectance map by Kd and stays below 1", "[maps]") {
  Scene scene = sceneOf({quad("q", squareCorners)});
  scene.materials[0].reflectance = {0.5, 0.9999, 0.25};
  scene.materials[0].reflectanceMap = 0;
  scene.images = {Image{1, 1, {{0.5, 2, 1}}}};
  const Discretization discretization = discretize(scene, {.texels = 2});
  for (std::uint32_t e = 0; e < 4; ++e)
    CHECK(areClose(reflectance(scene, discretization, e), {0.25, 0.9999, 0.25}, 1e-15));
  CHECK(discretization.mappedEmission.empty());
}

TEST_CASE("averageMaps keeps the material's values of surfaces without a map beside one with a map", "[maps]") {
  Scene scene = sceneOf({quad("plain", squareCorners), quad("mapped", squareCorners)});
  scene.materials.resize(2);
  scene.materials[0].emission = {1, 2, 3};
  scene.materials[1].emission = {10, 10, 10};
  scene.materials[1].emissionMap = 0;
  scene.surfaces[1].material = 1;
  scene.images = {Image{1, 1, {{0.5, 0.25, 0}}}};
  const Discretization discretization = discretize(scene, {.texels = 1});
  CHECK(emission(scene, discretization, 0) == glm::dvec3(1, 2, 3));
  CHECK(emission(scene, discretization, 1) == glm::dvec3(5, 2.5, 0));
  CHECK(reflectance(scene, discretization, 1) == glm::dvec3(0.5));
}
