#include "radiosity/bands/spectral_scene.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "radiosity/scene/load_scene.h"
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

TEST_CASE("groupsOfBands has each band once, at placeOf, from the longest wavelength on", "[bands]") {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 31u}) {
    const std::vector<BandGroup> groups = groupsOfBands(count);
    CHECK(groups.size() == (count + 2) / 3);
    std::size_t bands = 0;
    for (const BandGroup& group : groups)
      for (const std::vector<std::size_t>& place : group) bands += place.size();
    CHECK(bands == count);
    for (std::size_t band = 0; band < count; ++band) {
      const BandPlace at = placeOf(band, count);
      CHECK(groups[at.group][static_cast<std::size_t>(at.place)] == std::vector{band});
    }
    CHECK(groups[0][0] == std::vector{count - 1});
  }
}

TEST_CASE("wholeSpectrum has each band once, in the place of the colour that stands for it", "[bands]") {
  const BandGroup group = wholeSpectrum(std::vector<double>{300, 489.9, 490, 550, 589.9, 590, 1000});
  CHECK(group == BandGroup{std::vector<std::size_t>{5, 6}, {2, 3, 4}, {0, 1}});
}

TEST_CASE("reflectanceIn and lightIn give the spectra of colours the colours, within 0.08", "[bands]") {
  const std::vector<double> wavelengths = evenly(301);
  const std::vector<BandGroup> groups = groupsOfBands(wavelengths.size());
  for (const glm::dvec3& colour : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0.2, 1, 0.7}, {1, 1, 1}}) {
    Spectrum paint{wavelengths, std::vector<double>(wavelengths.size())}, light = paint;
    for (std::size_t band = 0; band < wavelengths.size(); ++band) {
      const BandPlace at = placeOf(band, wavelengths.size());
      paint.values[band] = reflectanceIn(groups[at.group], wavelengths, colour)[at.place];
      light.values[band] = (lightIn(groups[at.group], wavelengths) * colour)[at.place];
    }
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(reflectanceColour(paint)[channel] == Approx(colour[channel]).margin(0.08));
      CHECK(linearSrgb(light)[channel] == Approx(colour[channel]).margin(0.08));
    }
  }
}

TEST_CASE("lightIn keeps the flux of a grey light of all bands, and reflectanceIn the reflectance", "[bands]") {
  const std::vector<double> wavelengths = evenly(30);
  const BandGroup whole = wholeSpectrum(wavelengths);
  glm::dvec3 sum(0);
  for (const BandGroup& group : groupsOfBands(30)) sum += lightIn(group, wavelengths) * glm::dvec3(2);
  CHECK(bandSum(lightIn(whole, wavelengths) * glm::dvec3(2)) == Approx(bandSum(sum)).epsilon(1e-14));
  CHECK(reflectanceIn(whole, wavelengths, {0.1, 0.2, 0.3}).g == Approx(0.2).epsilon(1e-14));
}

TEST_CASE("inGroup gives the bits of the values at three wavelengths to R, G and B", "[bands]") {
  Scene scene = tests::closedCube({0.1, 0.2, 0.3}, {1, 2, 3});
  const std::vector<double> wavelengths{450, 550, 650};
  SpectralBands bands{wavelengths, {{"grey", {{{wavelengths, {0.7, 0.6, 0.5}}}, {{wavelengths, {3, 2, 1}}}}}}};
  const Scene spectral = inGroup(scene, bands, groupsOfBands(3)[0]);
  CHECK(spectral.materials[0].reflectance == glm::dvec3(0.5, 0.6, 0.7));
  CHECK(spectral.materials[0].emission == glm::dvec3(1, 2, 3));
  bands.materials.clear();
  CHECK(inGroup(scene, bands, groupsOfBands(3)[0]).materials[0].reflectance == glm::dvec3(0.1, 0.2, 0.3));
}

TEST_CASE("inGroup exchanges the channels of maps and of light from outside for those of the bands", "[bands]") {
  Scene scene = tests::closedCube({0.1, 0.2, 0.3}, {1, 2, 3});
  scene.images.push_back({1, 1, {{0.4, 0.5, 0.6}}});
  scene.outside = {{3, 6, 9}, {{{0, 1, 0}, {1, 2, 4}}}};
  const std::vector<double> wavelengths{430, 460, 480, 600, 610};
  const glm::dvec3 white = linearSrgb({{555}, {1}});
  const std::vector<BandGroup> groups = groupsOfBands(5);
  const Scene first = inGroup(scene, {wavelengths, {}}, groups[0]),
              second = inGroup(scene, {wavelengths, {}}, groups[1]);
  CHECK(first.images[0].pixels[0] == glm::dvec3(0.4, 0.4, 0.6));
  CHECK(first.materials[0].reflectance == glm::dvec3(0.1, 0.1, 0.3));
  CHECK(glm::length(first.outside.sky - glm::dvec3(3 / white.r, 3 / white.r, 9 / white.b)) < 1e-14);
  CHECK(glm::length(second.outside.suns[0].irradiance - glm::dvec3(4 / white.b, 4 / white.b, 0)) < 1e-14);
  CHECK(second.materials[0].reflectance.z == 0);  // an empty place
  CHECK(second.materials[0].emission.z == 0);
}

TEST_CASE("inColour shows spectra as valid colours", "[bands]") {
  const Scene scene = tests::closedCube(glm::dvec3(0.2), glm::dvec3(0));
  const std::vector<double> wavelengths{600, 650, 660};
  const SpectralBands bands{wavelengths, {{"grey", {{{wavelengths, {0.99, 0.99, 0.99}}}, {{wavelengths, {0, 0, 1}}}}}}};
  const Material material = inColour(scene, bands, 0.95).materials[0];
  CHECK(material.reflectance == glm::dvec3(0.95));
  CHECK(material.emission.r > 0);
  CHECK(material.emission.g == 0);  // outside sRGB
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
