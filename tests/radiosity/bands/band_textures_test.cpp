#include "radiosity/bands/band_textures.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/images/image.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"
#include "tests/support/box_scene.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("bandName is the wavelength with its shortest digits", "[bands]") {
  CHECK(bandName(450) == "b_450");
  CHECK(bandName(452.5) == "b_452.5");
}

// readImage gives the first three channels, which are R, G and B. The header names the others.
TEST_CASE("writeBandTextures adds a channel per band to the colours of each texture", "[bands]") {
  const Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  const Discretization discretization = discretize(scene, {.texels = 2});
  const TextureLayout layout = layOutTextures(scene, discretization, {1});
  const std::size_t elements = discretization.elements.size();
  Solution solution{.radiosity = {}, .radiosityInBands = BandTable(elements, 4)};
  for (std::size_t e = 0; e < elements; ++e) solution.radiosity.emplace_back(e, 0.5, -1);
  const TemporaryFolder folder;
  writeBandTextures(folder.path, discretization, layout, solution, {650.5, 500, 450, 400});
  const std::vector<Image> expected = radiosityTextures(discretization, layout, solution.radiosity);
  for (std::size_t t = 0; t < layout.names.size(); ++t) {
    const std::filesystem::path file = folder.path / (layout.names[t] + ".exr");
    CHECK(readImage(file).pixels == expected[t].pixels);
    const std::string bytes = raster::readFile(file, "");
    for (const char* name : {"B", "G", "R", "b_400", "b_450", "b_500", "b_650.5"})
      CHECK(bytes.find(std::string(name) + '\0') != std::string::npos);
  }
}
