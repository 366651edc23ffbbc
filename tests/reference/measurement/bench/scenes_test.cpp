// The scenes for measurements of speed.
#include "reference/measurement/bench/scenes.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;

TEST_CASE("benchScene discretizes a file of the user by defaults, also if it has the name of a scene of benchScenes",
          "[bench]") {
  const std::vector<reference::BenchScene> scenes = reference::benchScenes(HEMITEX_DATA);
  REQUIRE(scenes.size() == 3);
  CHECK(radiosity::discretize(scenes[0].scene, scenes[0].elements).elements.size() == 3841);
  // 3205 elements of the gallery lie inside solids, completely or with more than three quarters of their area.
  CHECK(radiosity::discretizeUnburied(scenes[2].scene, scenes[2].elements).elements.size() == 422031);
  CHECK(radiosity::discretize(scenes[2].scene, scenes[2].elements).elements.size() == 422031 - 3205);
  const reference::BenchScene own = reference::benchScene(HEMITEX_DATA "/paper-room.obj");
  CHECK(own.name == "paper-room");
  CHECK(own.elements.surfaceTexels.empty());
}

TEST_CASE("benchScene refuses a scene without emission", "[bench]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "dark.obj";
  raster::writeFile(file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK_THROWS_AS(reference::benchScene(file), raster::InputError);
}
