// parseMaterials: reflectance, emission and maps, and errors with their line.
#include "radiosity/scene/mtl_file.h"

#include <catch2/catch.hpp>

#include "radiosity/scene/scene_settings.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using radiosity::MaterialStatement;
using radiosity::parseMaterials;

TEST_CASE("parseMaterials throws InputError with the line of an error", "[material]") {
  struct Case {
    std::string text;
    int line;
    std::string id;
  };
  const auto [text, line, id] = GENERATE(values<Case>({
      {"newmtl a\nKd 0.5 x 0.5\n", 2, "'x' is not a number"},
      {"newmtl a\nKd 0.5 nan 0.5\n", 2, "'nan' is not a finite number"},
      {"newmtl a\n\nKe 1 inf 1\n", 3, "'inf' is not a finite number"},
      {"newmtl a\nKd 0.5 0.5\n", 2, "Kd has 3 numbers"},
      {"newmtl a\nKe\n", 2, "Ke has 3 numbers"},
      {"newmtl a\nKd 0.5 0.5 0.5 1\n", 2, "one number too many"},
      {"newmtl a\nKd spectral\n", 2, "Kd spectral names no file"},
      {"newmtl a\nKe spectral bulb.rfl -1\n", 2, "the factor of Ke spectral is not between 0 and 1e30"},
      {"newmtl a\nKe spectral bulb.rfl inf\n", 2, "the factor of Ke spectral is not between 0 and 1e30"},
      {"newmtl a\nKd xyz 1 1 1\n", 2, "'xyz' is not a number"},
      {"newmtl a\r\nKd 0.5 0.5 -0.1\r\n", 2, "Kd is negative"},
      {"newmtl a\nKd 1 1 1\nnewmtl b\nKe -1e-300 0 0\n", 4, "Ke is negative"},
      {"newmtl a\nKe 1 1e30 1.001e30\n", 2, "Ke is above 1e30"},
  }));
  CAPTURE(text);
  try {
    parseMaterials(text, "room.mtl");
    FAIL("accepted");
  } catch (const raster::InputError& error) {
    CHECK(error.file() == "room.mtl");
    CHECK(error.line() == line);
    CHECK_THAT(error.what(), Catch::Contains(id));
  }
}

TEST_CASE("parseMaterials compares Ke as a radiosity with the largest emission", "[material_file]") {
  using radiosity::EmissionUnit;
  const auto read = [](const std::string& emission, EmissionUnit unit) {
    return parseMaterials("newmtl a\nKe " + emission + "\n", "room.mtl", unit);
  };
  CHECK_NOTHROW(read("1e30", EmissionUnit::Radiosity));
  CHECK(read("3e29", EmissionUnit::Radiance)[0].emission == glm::dvec3(3e29));  // as written
  CHECK_THROWS_WITH(read("3.2e29", EmissionUnit::Radiance), Catch::Contains("room.mtl:2: Ke is above 1e30 / pi"));
}

TEST_CASE("parseMaterials returns only the values that the file states", "[material]") {
  const std::vector<MaterialStatement> materials = parseMaterials(
      "Kd 9 9 9\n# a comment\nnewmtl red paint\nKa x\n\tKd 0.7 0.1 0.1 # dull\nNs 10\n"
      "newmtl lamp\nKe 12\nKd 0 0 0\nillum 2\nnewmtl bare\n",
      "room.mtl");
  REQUIRE(materials.size() == 3);
  CHECK(materials[0].name == "red paint");
  CHECK(materials[0].reflectance == glm::dvec3(0.7, 0.1, 0.1));
  CHECK_FALSE(materials[0].emission);
  CHECK(materials[1].emission == glm::dvec3(12));
  CHECK(materials[1].reflectance == glm::dvec3(0));
  CHECK(materials[2].name == "bare");
  CHECK_FALSE(materials[2].reflectance);
  CHECK_FALSE(materials[2].reflectanceMap);
}

TEST_CASE("parseMaterials reads the file name of a map behind its options", "[material]") {
  struct Case {
    std::string line, image, omitted;
    glm::dvec2 scale{1, 1}, offset{0, 0};
    bool isClamped = false;
  };
  const auto [line, image, omitted, scale, offset, isClamped] = GENERATE(values<Case>({
      {"map_Kd wood.png", "wood.png", ""},
      {"map_Kd  maps/old wood.png ", "maps/old wood.png", ""},
      {"map_Kd -s 2 3 1 -clamp on wood.png", "wood.png", "", {2, 3}, {0, 0}, true},
      {"map_Kd -s 2 3 4th wood.png", "4th wood.png", "", {2, 3}},
      {"Map_Kd -s 2 -clamp off -o .5 wood.png", "wood.png", "", {2, 1}, {0.5, 0}},
      {"map_Kd -o 1 -2 3 -mm 0.1 2 -blendu off wood.png", "wood.png", "-mm", {1, 1}, {1, -2}},
      {"map_Kd -imfchan r -t 1 wood-1.png", "wood-1.png", "-imfchan -t"},
      {"map_Kd C:\\maps\\wood.png", "C:\\maps\\wood.png", ""},
      {"map_Kd \\\nwood.png", "wood.png", ""},
      {"map_Kd -s 2 2 1", "", "", {2, 2}},
      {"map_Kd", "", ""},
  }));
  CAPTURE(line);
  const std::vector<MaterialStatement> materials = parseMaterials("newmtl a\n" + line + "\nmap_Ke sky.exr\n", "");
  REQUIRE(materials[0].reflectanceMap);
  CHECK(materials[0].reflectanceMap->image == image);
  CHECK(materials[0].reflectanceMap->omitted == omitted);
  const radiosity::Sampler& sampler = materials[0].reflectanceMap->sampler;
  CHECK(sampler(glm::dvec2(3, 5)) == scale * glm::dvec2(3, 5) + offset);
  CHECK(sampler.wrap[0] == (isClamped ? radiosity::Wrap::Clamp : radiosity::Wrap::Repeat));
  CHECK(materials[0].emissionMap->image == "sky.exr");
}

TEST_CASE("parseMaterials reads what lets light through", "[material]") {
  const std::vector<MaterialStatement> read = parseMaterials(
      "newmtl a\nd 0.3\nnewmtl b\nd 1\nTr 0\nnewmtl c\nTr 0.5\nnewmtl d\nmap_d leaf.png\nd\n", "room.mtl");
  REQUIRE(read.size() == 4);
  CHECK(read[0].dissolve == 0.3);
  CHECK((read[1].dissolve == 1.0 && read[1].transparency == 0.0));
  CHECK((!read[2].dissolve && read[2].transparency == 0.5));
  CHECK((read[3].dissolveMap->image == "leaf.png" && !read[3].dissolve));
}

TEST_CASE("parseMaterials reads spectra with factors; the last Kd or Ke of a material counts", "[material]") {
  const std::vector<MaterialStatement> materials = parseMaterials(
      "newmtl a\nKd 0.5\nKd spectral red paint.rfl\nKe spectral bulb.rfl 2.5 # warm\n"
      "newmtl b\nKd spectral 3 0.25\nKe spectral bulb.rfl\nKe 1 2 3\n",
      "room.mtl");
  CHECK_FALSE(materials[0].reflectance);
  CHECK(materials[0].reflectanceSpectrum->spectrum == "red paint.rfl");
  CHECK(materials[0].reflectanceSpectrum->factor == 1);
  CHECK(materials[0].emissionSpectrum->spectrum == "bulb.rfl");
  CHECK(materials[0].emissionSpectrum->factor == 2.5);
  CHECK(materials[0].emissionSpectrum->line == 4);
  CHECK(materials[1].reflectanceSpectrum->spectrum == "3");
  CHECK(materials[1].reflectanceSpectrum->factor == 0.25);
  CHECK_FALSE(materials[1].emissionSpectrum);
  CHECK(materials[1].emission == glm::dvec3(1, 2, 3));
}

TEST_CASE("readSpectrum scales the spectrum beside the material file, and names the line of a missing one",
          "[material]") {
  const TemporaryFolder folder;
  raster::writeFile(folder.path / "red.rfl", "400 0.1\n700 0.8\n");
  const radiosity::Spectrum spectrum = radiosity::readSpectrum({"red.rfl", 0.5, 7}, folder.path / "room.mtl");
  CHECK(spectrum == radiosity::Spectrum{{400, 700}, {0.05, 0.4}});
  CHECK_THROWS_WITH(radiosity::readSpectrum({"blue.rfl", 1, 7}, folder.path / "room.mtl"),
                    Catch::Contains("room.mtl:7: the spectrum") && Catch::Contains("blue.rfl cannot be read"));
}
