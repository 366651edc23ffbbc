/// makeLightMaps and writeLightMaps: reflectance times light map is the display texture; the files are parsed.
#include "radiosity/textures/light_maps.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"
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

namespace {

/// A quad of two triangles in two nodes, one a mirror image, with things that hemitex does not read.
json quads() {
  json file = json::parse(R"({"asset": {"version": "2.0", "extras": {"by": "a painter"}}, "scene": 0,
    "scenes": [{"nodes": [0, 1, 2], "name": "all"}],
    "nodes": [{"mesh": 0, "extras": {"id": 7}}, {"mesh": 0, "scale": [-1, 1, 1], "translation": [5, 0, 1]},
              {"name": "lamp", "translation": [0, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}},
              {"mesh": 1, "name": "of no scene"}],
    "extensionsUsed": ["KHR_lights_punctual", "EXT_of_somebody", "KHR_materials_clearcoat"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5, "range": 9.5}]},
                   "EXT_of_somebody": {"words": ["a", 1, null, 1e-7]}},
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                    "samplers": [{"input": 3, "output": 0}]}],
    "images": [{"uri": "leaf.png"}], "textures": [{"source": 0}, {"source": 0}],
    "materials": [{"name": "paint", "normalTexture": {"index": 1, "scale": 0.3}, "extras": {"cost": 12},
                   "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "roughnessFactor": 0.37},
                   "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.4}}}],
    "meshes": [{"name": "quad", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "_OWN": 3}, "indices": 2,
                                                "material": 0, "extras": "kept"}]},
               {"primitives": [{"attributes": {"POSITION": 0}, "mode": 1}]}],
    "buffers": [{"byteLength": 92}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                    {"buffer": 0, "byteOffset": 80, "byteLength": 6}, {"buffer": 0, "byteOffset": 88, "byteLength": 4}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0],
                   "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                  {"bufferView": 2, "componentType": 5121, "count": 6, "type": "SCALAR"},
                  {"bufferView": 3, "componentType": 5121, "count": 4, "type": "SCALAR"}]})");
  return file;
}

const std::string quadBytes = [] {
  const std::vector<float> values{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0};
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)) +
         std::string("\0\1\2\0\2\3\0\0\11\12\13\14", 12);
}();

/// A glTF file in `folder`, read, with light maps beside it.
struct EditedFile {
  Scene scene;
  Discretization discretization;
  TextureLayout layout;
  Glb glb;
  std::vector<std::string> warnings;

  /// The irradiance of an element is the distance of its middle from x = 0, or 1.
  EditedFile(const std::filesystem::path& folder, const json& description, bool isMasked = false,
             const std::string& bytes = quadBytes, bool isRamp = false) {
    const std::vector<unsigned char> png =
        encodePng({2, 1, {255, 255, 255, 0, 0, 0}, {}, isMasked ? std::vector{true, false} : std::vector<bool>()}, "a");
    raster::writeFile(folder / "leaf.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    raster::writeFile(folder / "a.glb", glbBytes({description, bytes}));
    scene = loadScene(folder / "a.glb");
    discretization = discretize(scene, {.texels = 4});
    layout = layOutTextures(scene, discretization, {});
    std::vector<glm::dvec3> irradiance(discretization.elements.size(), glm::dvec3(1));
    if (isRamp)
      for (std::uint32_t e = 0; e < irradiance.size(); ++e)
        irradiance[e] = glm::dvec3(elementCentre(scene, discretization, e).position.x);
    const LightMaps maps = makeLightMaps(scene, discretization, layout, irradiance, exposure, TextureFilter::Bilinear);
    warnings = writeLightMaps(folder, maps, scene, discretization, layout,
                              radiosityTextures(discretization, layout, irradiance), {});
    glb = parseGlb(readAll(folder / "lightmap.glb"));
  }
};

using Corners = std::vector<std::array<double, 5>>;

/// The places of all corners, with the coordinates in light maps, counted from the top; sorted.
Corners cornersOf(const EditedFile& edited) {
  Corners corners;
  for (std::uint32_t s = 0; s < edited.scene.surfaces.size(); ++s)
    for (const Triangle& triangle : edited.scene.surfaces[s].triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& p = triangle.position[k];
        const glm::dvec2 place = textureCoordinate(edited.discretization, edited.layout, s, triangle.chart[k]);
        corners.push_back({p.x, p.y, p.z, static_cast<float>(place.x), static_cast<float>(1 - place.y)});
      }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The same of lightmap.glb, whose textures are read with the coordinates in light maps.
Corners cornersOfGlb(const std::filesystem::path& folder, Glb glb) {
  for (json& material : glb.description["materials"])
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0},
                                                            {"texCoord", material["extras"]["lightMapTexCoord"]}};
  raster::writeFile(folder / "again.glb", glbBytes(glb));
  Corners corners;
  for (const Surface& surface : loadScene(folder / "again.glb").surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& p = triangle.position[k];
        corners.push_back({p.x, p.y, p.z, triangle.texcoord[k].x, 1 - triangle.texcoord[k].y});
      }
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

TEST_CASE("writeLightMaps edits a glTF file, of which all else comes back untouched", "[light-maps]") {
  const TemporaryFolder folder;
  const json given = quads();
  const EditedFile edited(folder.path, given);
  CHECK(edited.warnings.empty());
  const json& written = edited.glb.description;
  for (const char* const key : {"asset", "scene", "scenes", "extensionsUsed", "extensions", "animations", "textures"})
    CHECK(written[key] == given[key]);
  CHECK(edited.glb.buffer.starts_with(quadBytes));
  for (std::size_t i = 0; i < 4; ++i) CHECK(written["accessors"][i] == given["accessors"][i]);
  CHECK(written["nodes"][0]["extras"] == given["nodes"][0]["extras"]);
  CHECK(written["nodes"][2] == given["nodes"][2]);
  CHECK(written["nodes"][3] == given["nodes"][3]);
  CHECK(written["meshes"][1] == given["meshes"][1]);
  const auto image = written["images"][0]["bufferView"].get<std::size_t>();
  CHECK(viewBytes(edited.glb, image) == readAll(folder.path / "leaf.png"));
  CHECK(written["images"][0]["mimeType"] == "image/png");
  for (const std::size_t node : {0U, 1U}) {  // each node has a light map of its own
    const json& primitive = written["meshes"][written["nodes"][node]["mesh"].get<std::size_t>()]["primitives"].at(0);
    json attributes = primitive["attributes"];
    CHECK(attributes.contains("TEXCOORD_1"));
    attributes.erase("TEXCOORD_1");
    CHECK(attributes == given["meshes"][0]["primitives"][0]["attributes"]);
    CHECK(primitive["indices"] == 2);
    CHECK(primitive["extras"] == "kept");
    json material = written["materials"][primitive["material"].get<std::size_t>()];
    const std::string& texture = edited.layout.names[node];
    CHECK(material["extras"]["lightMap"] == "lightmaps/" + texture + ".png");
    CHECK(material["extras"]["exposure"] == exposure);
    CHECK(material["name"] == (node == 0 ? "paint" : "paint/" + texture));
    material["name"] = "paint";
    material["extras"] = {{"cost", material["extras"]["cost"]}};
    CHECK(material == given["materials"][0]);
  }
  const Corners expected = cornersOf(edited), found = cornersOfGlb(folder.path, edited.glb);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t k = 0; k < 5; ++k) CHECK(found[i][k] == Approx(expected[i][k]).margin(1e-6));
}

TEST_CASE("writeLightMaps gives vertices of several coordinates copies, and both sides of a leaf their own",
          "[light-maps]") {
  const TemporaryFolder folder;
  json leaf = quads();
  leaf["materials"][0].update({{"alphaMode", "MASK"}, {"doubleSided", true}});
  EditedFile edited(folder.path, leaf, true);
  REQUIRE(edited.scene.surfaces.size() == 4);
  std::size_t primitives = 0;
  for (const std::size_t node : {0U, 1U})
    for (const json& primitive :
         edited.glb
             .description["meshes"][edited.glb.description["nodes"][node]["mesh"].get<std::size_t>()]["primitives"]) {
      ++primitives;
      const auto& accessor = edited.glb.description["accessors"][primitive["attributes"]["_OWN"].get<std::size_t>()];
      CHECK(accessor["componentType"] == 5121);
      CHECK(edited.glb.description["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["max"] ==
            json({1.0, 1.0, 0.0}));
      const std::string own = viewBytes(edited.glb, accessor["bufferView"]);
      CHECK(own.size() == 16);  // each value takes four bytes
      CHECK(own[0] == 011);
    }
  CHECK(primitives == 4);
  for (json& material : edited.glb.description["materials"]) {
    CHECK_FALSE(material.contains("doubleSided"));  // each side is there
    material["alphaMode"] = "OPAQUE";
  }
  const Corners expected = cornersOf(edited), found = cornersOfGlb(folder.path, edited.glb);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t k = 0; k < 5; ++k) CHECK(found[i][k] == Approx(expected[i][k]).margin(1e-6));

  leaf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;  // one place for both sides
  edited = EditedFile(folder.path, leaf, true);
  REQUIRE(edited.warnings.size() == 2);
  CHECK_THAT(edited.warnings[0], Catch::EndsWith("both sides of triangle 1 are lit"));
}

TEST_CASE("writeLightMaps uses second texture coordinates that are a chart", "[light-maps]") {
  const TemporaryFolder folder;
  json given = quads();
  json& attributes = given["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_1"] = 1;  // u is x, and v = 0 where y = 1
  const EditedFile edited(folder.path, given, false, quadBytes, true);
  CHECK(edited.warnings.empty());
  const json& written = edited.glb.description;
  for (const std::size_t node : {0U, 1U}) {
    const json& primitive = written["meshes"][written["nodes"][node]["mesh"].get<std::size_t>()]["primitives"].at(0);
    CHECK(primitive["attributes"] == attributes);
    const json& extras = written["materials"][primitive["material"].get<std::size_t>()]["extras"];
    CHECK(extras["lightMapTexCoord"] == 1);
    CHECK(extras["lightMap"].get<std::string>().ends_with("-texcoord-1.png"));
    // Four elements lie along x: their light is a ramp between the middles of the first and the last one.
    const Image light = readImage(folder.path / extras["lightMapLinear"].get<std::string>());
    for (int column = 0; column < light.width; ++column) {
      const double u = (column + 0.5) / light.width, ramp = std::clamp(u, 0.125, 0.875);
      for (int row = 0; row < light.height; ++row)
        CHECK(light.pixels[static_cast<std::size_t>(row * light.width + column)].x ==
              Approx(node == 0 ? ramp : 5 - ramp).epsilon(1e-6));
    }
  }
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "lightmaps")) files += entry.exists();
  CHECK(files == 4);  // none that shows nothing
}

TEST_CASE("writeLightMaps says why second texture coordinates are not used", "[light-maps]") {
  using Values = std::vector<float>;
  const auto [values, problem] = GENERATE(table<Values, std::string>({
      {{0, 0, 1, 0, 1, 1.5F, 0, 1}, "triangle 1 leaves the unit square"},
      {{-0.1F, 0, 1, 0, 1, 1, 0, 1}, "triangle 1 leaves the unit square"},
      {{0, 0, 0.5F, 0.5F, 1, 1, 0, 1}, "triangle 1 has no area in them"},
      {{0, 0, 1, 0, 1, 1, 1, 1}, "triangle 2 has no area in them"},
      {{0, 0, 1, 0, 1, 1, 0.9F, 0.1F}, "triangle 2 overlaps triangle 1"},
  }));
  const TemporaryFolder folder;
  json given = quads();
  given["buffers"][0]["byteLength"] = 124;
  given["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 92}, {"byteLength", 32}});
  given["accessors"].push_back({{"bufferView", 4}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  given["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 4;
  const std::string bytes =
      quadBytes + std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  const EditedFile edited(folder.path, given, false, bytes);
  REQUIRE(edited.warnings.size() == 2);  // of each node
  for (const std::string& warning : edited.warnings)
    CHECK_THAT(warning, Catch::Contains("TEXCOORD_1 of `quad") && Catch::EndsWith(problem));
  const json& written = edited.glb.description;
  const json& primitive = written["meshes"][written["nodes"][0]["mesh"].get<std::size_t>()]["primitives"].at(0);
  CHECK(primitive["attributes"]["TEXCOORD_1"] == 4);
  CHECK(primitive["attributes"].contains("TEXCOORD_2"));

  given["accessors"][4]["count"] = 3;  // of four vertices
  const EditedFile faulty(folder.path, given, false, bytes);
  CHECK(faulty.warnings.empty());
  CHECK(std::any_of(faulty.scene.warnings.begin(), faulty.scene.warnings.end(), [](const std::string& warning) {
    return warning.starts_with("TEXCOORD_1 of a mesh is left out: ");
  }));
}

TEST_CASE("writeLightMaps says why a glTF file is not edited", "[light-maps]") {
  const TemporaryFolder folder;
  json instances = quads();
  instances["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
  const EditedFile edited(folder.path, instances);
  REQUIRE(edited.warnings.size() == 1);
  CHECK_THAT(edited.warnings[0], Catch::Contains("EXT_mesh_gpu_instancing"));
  CHECK_FALSE(edited.glb.description.contains("animations"));
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
