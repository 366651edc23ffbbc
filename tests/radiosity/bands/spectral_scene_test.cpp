#include "radiosity/bands/spectral_scene.h"

#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/file_io.h"
#include "tests/support/box_scene.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

std::vector<double> evenly(std::size_t count) {
  std::vector<double> wavelengths;
  for (std::size_t i = 0; i < count; ++i)
    wavelengths.push_back(400 + 300.0 * static_cast<double>(i) / static_cast<double>(count));
  return wavelengths;
}

}  // namespace

TEST_CASE("reflectanceInBands and lightInBands give the spectra of colours the colours, within 0.08", "[bands]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const std::vector<double> ascending = evenly(301);
  scene.wavelengths.assign(ascending.rbegin(), ascending.rend());
  const auto spectrum = [&](const Bands& values) { return Spectrum{ascending, {values.rbegin(), values.rend()}}; };
  for (const glm::dvec3& colour : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0.2, 1, 0.7}, {1, 1, 1}}) {
    const glm::dvec3 paint =
                         reflectanceColour(spectrum(reflectanceInBands(scene, tests::material("m", colour, colour)))),
                     light = linearSrgb(spectrum(lightInBands(scene, colour)));
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(paint[channel] == Approx(colour[channel]).margin(0.08));
      CHECK(light[channel] == Approx(colour[channel]).margin(0.08));
    }
  }
}

TEST_CASE("reflectanceInBands and emissionInBands have the bits of a spectrum, and of a colour its channels",
          "[bands]") {
  const Scene scene = tests::closedCube({0.1, 0.2, 0.3}, {1, 2, 3});
  CHECK(reflectanceInBands(scene, scene.materials[0]) == Bands{0.1, 0.2, 0.3});
  CHECK(emissionInBands(scene, scene.materials[0]) == Bands{1, 2, 3});
  const std::vector<double> wavelengths{430, 489.9, 490, 589.9, 590};
  const Scene coloured = inBands(scene, {wavelengths, {}}, 0.95);
  CHECK(reflectanceInBands(coloured, coloured.materials[0]) == Bands{0.1, 0.2, 0.2, 0.3, 0.3});
  const glm::dvec3 white = linearSrgb({{555}, {1}});
  CHECK(lightInBands(coloured, {2, 4, 8}) == Bands{2 / white.r, 4 / white.g, 4 / white.g, 8 / white.b, 8 / white.b});
  const SpectralBands bands{wavelengths,
                            {{"grey", {{{wavelengths, {0.7, 0.6, 0.5, 0.4, 0.3}}}, {{wavelengths, {5, 4, 3, 2, 1}}}}}}};
  const Scene spectral = inBands(scene, bands, 0.95);
  CHECK(reflectanceInBands(spectral, spectral.materials[0]) == Bands{0.3, 0.4, 0.5, 0.6, 0.7});
  CHECK(emissionInBands(spectral, spectral.materials[0]) == Bands{1, 2, 3, 4, 5});
}

TEST_CASE("inBands shows spectra as valid colours, and warns of materials that have only a colour", "[bands]") {
  const Scene scene = tests::closedCube(glm::dvec3(0.2), glm::dvec3(0));
  const std::vector<double> wavelengths{600, 650, 660};
  const SpectralBands bands{wavelengths, {{"grey", {{{wavelengths, {0.99, 0.99, 0.99}}}, {{wavelengths, {0, 0, 1}}}}}}};
  const Scene shown = inBands(scene, bands, 0.95);
  CHECK(shown.materials[0].reflectance == glm::dvec3(0.95));
  CHECK(shown.materials[0].emission.r > 0);
  CHECK(shown.materials[0].emission.g == 0);  // outside sRGB
  CHECK(shown.warnings.empty());
  CHECK(inBands(scene, {wavelengths, {}}, 0.95).warnings.size() == 1);
}

TEST_CASE("inBands: a colour of an edit replaces a spectrum", "[bands]") {
  const std::vector<double> wavelengths{450, 650};
  const SpectralBands bands{wavelengths, {{"grey", {{{wavelengths, {0.7, 0.6}}}, {{wavelengths, {3, 2}}}}}}};
  Scene scene = inBands(tests::closedCube(glm::dvec3(0.2), glm::dvec3(0)), bands, 0.95);
  const std::vector<Edit> edits{SetReflectance{"grey", {0.1, 0.2, 0.3}}};
  scene = edited(std::move(scene), {}, edits).scene;
  const Material& material = scene.materials[static_cast<std::size_t>(scene.surfaces[0].material)];
  CHECK(reflectanceInBands(scene, material) == Bands{0.1, 0.3});
  CHECK(emissionInBands(scene, material) == Bands{2, 3});
}

TEST_CASE("spectraOfFiles reads the spectra of an MTL file, which loadScene shows as colours", "[bands]") {
  const TemporaryFolder folder;
  raster::writeFile(folder.path / "a.obj",
                    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
  raster::writeFile(folder.path / "a.mtl",
                    "newmtl a\nKd spectral paint.rfl 2\nKe spectral bulb.rfl 3\nnewmtl b\nKd spectral green.rfl\n"
                    "newmtl a\nKd spectral missing.rfl\n");
  raster::writeFile(folder.path / "paint.rfl", "400 0.25\n700 0.6\n");
  raster::writeFile(folder.path / "bulb.rfl", "400 0\n700 1\n");
  raster::writeFile(folder.path / "green.rfl", "500 0\n510 0.9\n530 0.9\n540 0\n");
  const SceneSettings settings{.emission = EmissionUnit::Radiance};
  const Scene scene = loadScene(folder.path / "a.obj", settings);
  const auto spectra = spectraOfFiles(scene, settings);
  CHECK(spectra.at("a").reflectance == Spectrum{{400, 700}, {0.5, 0.9999}});  // 1.2 is lowered
  CHECK(spectra.at("a").emission->values[1] == 3 * radiosityPerUnit(EmissionUnit::Radiance));
  CHECK_FALSE(spectra.at("b").emission);
  const glm::dvec3 warm = linearSrgb({{400, 700}, {0, 3}}) * radiosityPerUnit(EmissionUnit::Radiance);
  for (int channel = 0; channel < 3; ++channel)
    CHECK(scene.materials[0].emission[channel] == Approx(warm[channel]).epsilon(1e-14));
  // The green lies outside sRGB.
  CHECK(scene.materials[1].reflectance.r == 0);
  CHECK(scene.materials[1].reflectance.g > 0.2);
  CHECK_THAT(scene.warnings, Catch::VectorContains(std::string(
                                 "material 'b': the colour of green.rfl lies outside sRGB; its negative channels "
                                 "become 0")));
  CHECK_THAT(scene.files, Catch::VectorContains(folder.path / "bulb.rfl"));
}
