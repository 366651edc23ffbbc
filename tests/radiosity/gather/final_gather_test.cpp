/// gather: a white furnace, rows of single texels, interpolation, and the same bits for any number of threads.
#include "radiosity/gather/final_gather.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/light/light.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

struct Room {
  Scene scene;
  Discretization discretization = {};
  IdLayout layout = {};
  TextureLayout textures = {};
  Solution solution = {};

  Room(Scene of, int texels, int magnification)
      : scene(std::move(of)),
        discretization(discretize(scene, {.texels = texels})),
        layout(layOut(discretization)),
        textures(layOutTextures(scene, discretization, {magnification})) {}

  GatheredLight gathered(const GatherSettings& settings = {}) const {
    return *gather(scene, discretization, layout, textures, solution, settings);
  }
};

}  // namespace

TEST_CASE("gather in a white furnace finds 1 at each texel", "[gather]") {
  Room room(closedCube(glm::dvec3(0.25, 0.5, 0.75), glm::dvec3(0.75, 0.5, 0.25)), 4, 4);
  room.solution.radiosity.assign(room.discretization.elements.size(), glm::dvec3(1));
  const GatheredLight light = room.gathered();
  CHECK(light.texels == 6 * 16 * 16);
  CHECK(light.error < 1e-6);
  for (const std::vector<glm::dvec3>& texels : light.irradiance)
    for (const glm::dvec3& texel : texels)
      for (int band = 0; band < 3; ++band) CHECK(texel[band] == Approx(1).epsilon(1e-6));
  for (const Image& texture : radiosityTextures(room.scene, room.discretization, room.textures, light))
    for (const glm::dvec3& texel : texture.pixels) CHECK(texel.g == Approx(1).epsilon(1e-6));
}

TEST_CASE("gather without interpolation is the row of each texel times the radiosity of elements", "[gather]") {
  Room room(closedCube(glm::dvec3(0.5), glm::dvec3(0)), 3, 2);
  for (std::uint32_t e = 0; e < room.discretization.elements.size(); ++e)
    room.solution.radiosity.emplace_back(0.1 + 0.17 * (e % 9), 2.5 / (1 + e), e % 2);
  const GatheredLight light = room.gathered({.elements = 1, .resolution = 32, .even = 0, .tolerance = 0});
  CHECK(light.drawn == light.texels);
  SceneFormFactors rows(room.scene, room.discretization, room.layout, {.resolution = 32});
  for (std::uint32_t s = 0; s < room.scene.surfaces.size(); ++s)
    for (std::size_t texel : {0, 8, 35}) {
      const glm::dvec2 corner = 0.5 * glm::dvec2(texel % 6, texel / 6);
      const auto block = shootingBlock(room.scene.surfaces[s], room.discretization.grids[s], corner, glm::dvec2(0.5));
      const FormFactorRow row = rows.uncorrected().from(s, block->centre);
      glm::dvec3 sum(0);
      for (std::size_t i = 0; i < row.elements.size(); ++i)
        sum += room.solution.radiosity[row.elements[i]] * formFactor(row.shares[i]);
      for (int band = 0; band < 3; ++band) CHECK(light.irradiance[s][texel][band] == Approx(sum[band]).epsilon(1e-12));
    }
}

TEST_CASE("gather draws a share of the texels, within a few percent of all drawn, with equal bits by any threads",
          "[gather]") {
  Room room(loadScene(HEMITEX_DATA "/cornell-box.obj"), 8, 4);
  room.solution = light(room.scene, room.discretization, {.solver = {.residual = 0.05}}).solution;
  const auto withThreads = [&](int threads, const GatherSettings& settings) {
    const raster::ThreadLimit limit(threads);
    return room.gathered(settings);
  };
  const GatheredLight one = withThreads(1, {.resolution = 32}), three = withThreads(3, {.resolution = 32}),
                      all = withThreads(2, {.resolution = 32, .even = 0, .tolerance = 0});
  CHECK(one.irradiance == three.irradiance);
  CHECK(one.drawn == three.drawn);
  CHECK(one.error == three.error);
  CHECK(one.error < 0.02);
  CHECK(2 * one.drawn < one.texels);
  double squares = 0, light = 0;
  for (std::size_t s = 0; s < one.irradiance.size(); ++s)
    for (std::size_t i = 0; i < one.irradiance[s].size(); ++i) {
      const double difference = bandSum(one.irradiance[s][i] - all.irradiance[s][i]);
      squares += difference * difference;
      light += bandSum(all.irradiance[s][i]) * bandSum(all.irradiance[s][i]);
    }
  CHECK(std::sqrt(squares / light) < 0.02);
}
