/// makeLightMaps and writeLightMaps: reflectance times light map is the display texture; the files are parsed.
#include "radiosity/textures/light_maps.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "tests/support/glb.h"
#include "tests/support/picture_scenes.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using nlohmann::json;

namespace {

constexpr double exposure = 0.4;

/// Two walls of one material with textures, a lamp, and two floors that are Gouraud shaded.
struct LitRoom {
  Scene scene = sceneOf({parallelogram("wall#1", {0, 0, 0}, {4, 0, 0}, {0, 2, 0}),
                         parallelogram("wall#2", {0, 0, 0}, {0, 2, 0}, {0, 0, 2}),
                         parallelogram("lamp", {0, 5, 0}, {1, 0, 0}, {0, 0, 1}),
                         parallelogram("bright", {3, 0, 1}, {1, 0, 0}, {0, 1, 0}),
                         parallelogram("dark", {4, 0, 1}, {1, 0, 0}, {0, 1, 0})});
  Discretization discretization;
  TextureLayout layout;
  std::vector<glm::dvec3> irradiance, displayed;

  LitRoom() {
    scene.materials = {Material{.name = "red", .reflectance = {0.8, 0.3, 0.1}},
                       Material{.name = "lamp", .reflectance = {0.2, 0.2, 0.2}, .emission = {1, 2, 1.5}}};
    scene.surfaces[2].material = 1;
    scene.objects = {{"house"}, {"wall", 0}};
    scene.surfaces[0].object = scene.surfaces[1].object = 1;
    addGrid(discretization, 4, 2);
    addGrid(discretization, 3, 3);
    addGrid(discretization, 2, 2);
    for (int s = 0; s < 2; ++s) addGrid(discretization, 1, 1);
    layout = layOutTextures(scene, discretization, {8});
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
      irradiance.emplace_back(0.1 + 0.17 * (e % 9), 2.5 / (1 + e), 1.5);
      displayed.push_back(emission(scene, discretization, e) +
                          reflectance(scene, discretization, e) * irradiance.back());
    }
  }

  LightMaps maps() const {
    return makeLightMaps(scene, discretization, layout, irradiance, exposure, TextureFilter::Bicubic);
  }
  std::vector<CodedImage> shown() const {
    return makeLitScene(scene, discretization, layout, displayed, exposure, TextureFilter::Bicubic).textures;
  }
};

double linear(std::uint8_t code) { return decodeSrgb(code / 255.0); }

/// The largest distance from the linear value of a code to one that is rounded to it.
double halfStep(std::uint8_t code) {
  const double value = linear(code);
  return std::max(decodeSrgb(std::min((code + 0.5) / 255, 1.0)) - value,
                  value - decodeSrgb(std::max((code - 0.5) / 255, 0.0)));
}

}  // namespace

TEST_CASE("makeLightMaps gives display textures, divided by reflectance, within the codes of 8 bits", "[light-maps]") {
  const LitRoom room;
  const LightMaps maps = room.maps();
  const std::vector<CodedImage> shown = room.shown();
  // The irradiance of 2.5 meets a reflectance of 0.3, so that no band turns white.
  CHECK(maps.scale == Approx(exposure * 2.5));
  REQUIRE(maps.textures.size() == 5);
  for (std::size_t t = 0; t < 5; ++t) {
    const Material& material = room.scene.materials[static_cast<std::size_t>(room.scene.surfaces[t].material)];
    REQUIRE(maps.textures[t].codes.size() == shown[t].codes.size());
    for (std::size_t i = 0; i < shown[t].codes.size(); ++i) {
      const int band = static_cast<int>(i % 3);
      const std::uint8_t light = maps.textures[t].codes[i], code = shown[t].codes[i];
      const double factor = material.reflectance[band] * maps.scale;
      const double expected = exposure * material.emission[band] + factor * linear(light);
      if (code == 0) continue;  // extrapolated below 0 in the border
      REQUIRE(std::fabs(std::min(expected, 1.0) - linear(code)) <= halfStep(code) + factor * halfStep(light) + 1e-12);
    }
  }
}

TEST_CASE("makeLightMaps cuts light that makes surfaces white", "[light-maps]") {
  LitRoom room;
  room.irradiance[0] = glm::dvec3(1000);  // of a wall, whose darkest band has a reflectance of 0.1
  CHECK(room.maps().scale == Approx(10));
  room.irradiance.assign(room.irradiance.size(), glm::dvec3(0));
  CHECK(room.maps().scale == 1);
}

TEST_CASE("writeLightMaps writes the scene with its materials, both texture coordinates and light maps",
          "[light-maps]") {
  const TemporaryFolder folder;
  LitRoom room;
  room.scene.images = {Image{2, 1, {glm::dvec3(1), glm::dvec3(0)}}};
  room.scene.materials[1].reflectanceMap = 0;
  for (Surface& surface : room.scene.surfaces)
    for (Triangle& triangle : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) triangle.texcoord[k] = 3.0 * triangle.chart[k] - 1.0;
  const LightMaps maps = room.maps();
  const PictureView view{{{2, 1, 9}, {2, 1, 0}, {0, 1, 0}, 40}, 1.5};
  REQUIRE(writeLightMaps(folder.path, maps, room.scene, room.discretization, room.layout,
                         radiosityTextures(room.discretization, room.layout, room.irradiance), view)
              .empty());
  const Glb glb = parseGlb(readAll(folder.path / "lightmap.glb"));
  const json& gltf = glb.description;
  REQUIRE(gltf["nodes"].size() == 6);  // wall, lamp, bright, dark, house and the camera
  CHECK(gltf["nodes"][0]["name"] == "wall");
  CHECK(gltf["nodes"][4]["children"] == json({0}));
  const json& primitives = gltf["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 2);
  for (std::size_t p = 0; p < 2; ++p) {
    const json& material = gltf["materials"][primitives[p]["material"].get<std::size_t>()];
    const std::string& texture = room.layout.names[p];
    CHECK(material["name"] == "red/" + texture);
    CHECK(material["pbrMetallicRoughness"]["baseColorFactor"] == json({0.8, 0.3, 0.1, 1.0}));
    const json& extras = material["extras"];
    CHECK(extras["lightMap"] == "lightmaps/" + texture + ".png");
    CHECK(extras["lightMapScale"] == maps.scale);
    CHECK(extras["exposure"] == exposure);
    CHECK(readImage(folder.path / extras["lightMap"]).width == maps.textures[p].width);
    const Image exr = readImage(folder.path / extras["lightMapLinear"]);
    const std::uint32_t first = room.discretization.grids[p].firstElement;
    const auto corner = static_cast<std::size_t>((exr.height - 2) * exr.width + 1);
    CHECK(exr.pixels[corner] == glm::dvec3(glm::vec3(room.irradiance[first])));
    const auto own = accessorValues<glm::vec2>(glb, primitives[p]["attributes"]["TEXCOORD_0"]);
    const auto ofLight = accessorValues<glm::vec2>(glb, primitives[p]["attributes"]["TEXCOORD_1"]);
    REQUIRE(own.size() == 4);
    const Triangle& triangle = room.scene.surfaces[p].triangles[0];
    for (std::size_t k = 0; k < 3; ++k) {  // vertices are in the order of their first corners
      const glm::dvec2 place =
          textureCoordinate(room.discretization, room.layout, static_cast<std::uint32_t>(p), triangle.chart[k]);
      CHECK(own[k] == glm::vec2(triangle.texcoord[k].x, 1 - triangle.texcoord[k].y));
      CHECK(ofLight[k] == glm::vec2(place.x, 1 - place.y));
    }
  }
  const json& lamp = gltf["materials"][gltf["meshes"][1]["primitives"][0]["material"].get<std::size_t>()];
  CHECK(lamp["name"] == "lamp");
  CHECK(lamp["emissiveFactor"] == json({0.5, 1.0, 0.75}));
  CHECK(lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] == 2.0);
  CHECK(lamp["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 0);
  CHECK(gltf["samplers"][gltf["textures"][0]["sampler"].get<std::size_t>()]["wrapS"] == 10497);  // REPEAT
}

TEST_CASE("hemitex solve --lightmap writes lightmap.glb and a light map per texture", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--lightmap -o out");
  const json solution = json::parse(readAll(shell.file("out/solution.json")));
  for (const json& surface : solution["surfaces"]) {
    const std::string name = "out/lightmaps/" + surface["texture"]["name"].get<std::string>();
    CHECK(std::filesystem::exists(shell.file(name + ".png")));
    CHECK(std::filesystem::exists(shell.file(name + ".exr")));
  }
  CHECK(std::filesystem::exists(shell.file("out/lightmap.glb")));
  shell.output(quickSolve + "-o out");
  CHECK_FALSE(std::filesystem::exists(shell.file("out/lightmap.glb")));
  shell.output(quickSolve + "--lightmap --no-textures -o out");
  CHECK(std::filesystem::exists(shell.file("out/lightmap.glb")));
  CHECK_FALSE(std::filesystem::exists(shell.file("out/scene.glb")));
}
