/// Scenes from glTF files: equal to the same scene in OBJ, and one message for each fault.
#include "radiosity/scene/gltf_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "radiosity/images/image.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "tests/support/compressed_meshes.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using hemitex::tests::writeAll;
using nlohmann::json;

namespace {

constexpr int floatType = 5126, byteType = 5121, shortType = 5123, intType = 5125;

/// A glTF file under construction: JSON and one buffer.
struct Gltf {
  json text = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]})");
  std::string bytes;

  /// Adds a buffer view of these bytes and returns its index.
  int view(const std::string& content) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    text["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
    bytes += content;
    return static_cast<int>(text["bufferViews"].size()) - 1;
  }

  template <typename Component>
  int accessor(const std::vector<Component>& values, int componentType, const std::string& type, int components) {
    std::string content(values.size() * sizeof(Component), '\0');
    std::memcpy(content.data(), values.data(), content.size());
    const int index = view(content);
    text["accessors"].push_back({{"bufferView", index},
                                 {"componentType", componentType},
                                 {"count", values.size() / static_cast<std::size_t>(components)},
                                 {"type", type}});
    return static_cast<int>(text["accessors"].size()) - 1;
  }

  /// Adds a node with a mesh to the scene; its index is the last.
  void add(const std::string& name, const json& primitive, const json& transform = json::object()) {
    text["meshes"].push_back({{"primitives", {primitive}}});
    json node = transform;
    node["name"] = name;
    node["mesh"] = text["meshes"].size() - 1;
    text["nodes"].push_back(node);
    text["scenes"][0]["nodes"].push_back(text["nodes"].size() - 1);
  }

  /// The content of a .glb file: a header, the JSON and the buffer.
  std::string glb() const {
    json whole = text;
    if (!bytes.empty()) whole["buffers"][0] = {{"byteLength", bytes.size()}};
    std::string first = whole.dump(), second = bytes;
    first.resize((first.size() + 3) / 4 * 4, ' ');
    second.resize((second.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t value) {
      std::string result(4, '\0');
      for (std::size_t i = 0; i < 4; ++i) result[i] = static_cast<char>(value >> (8 * i));
      return result;
    };
    return "glTF" + word(2) + word(28 + first.size() + second.size()) + word(first.size()) + "JSON" + first +
           word(second.size()) + std::string("BIN\0", 4) + second;
  }
};

/// A file of a scene in a folder of its own.
struct SceneFile {
  TemporaryFolder folder;
  std::filesystem::path path;

  SceneFile(const std::string& name, const std::string& content) : path(folder.path / name) { writeAll(path, content); }
  Scene load(const SceneSettings& settings = {}) const { return loadScene(path, settings); }
};

const std::vector<float> square = {0, 0, 0, 4, 0, 0, 4, 0, -4, 0, 0, -4};
const std::vector<float> squareTexcoords = {0, 1, 0.5, 1, 0.5, 0.5, 0, 0.5};

/// Two squares that face each other: a floor, and a lamp which is the same mesh turned over, half as wide.
Gltf roomGltf() {
  Gltf gltf;
  const int positions = gltf.accessor(square, floatType, "VEC3", 3);
  const int texcoords = gltf.accessor(squareTexcoords, floatType, "VEC2", 2);
  const int indices = gltf.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, shortType, "SCALAR", 1);
  const json primitive = {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", texcoords}}}, {"indices", indices}};
  json floor = primitive, lamp = primitive;
  floor["material"] = 0;
  lamp["material"] = 1;
  gltf.text["materials"] = json::parse(R"([
    {"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.3, 0.1, 1], "metallicFactor": 1}},
    {"name": "glow", "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}, "emissiveFactor": [1, 0.5, 0.25],
     "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}}])");
  gltf.text["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  gltf.add("floor", floor);
  gltf.add("lamp", lamp, {{"rotation", {1, 0, 0, 0}}, {"scale", {0.5, 1, 0.5}}, {"translation", {0, 2, -4}}});
  return gltf;
}

const std::string roomMtl = "newmtl paint\nKd 0.7 0.3 0.1\nnewmtl glow\nKd 0 0 0\nKe 8 4 2\n";
const std::string roomObj =
    "mtllib room.mtl\nv 0 0 0\nv 4 0 0\nv 4 0 -4\nv 0 0 -4\nv 0 2 -4\nv 2 2 -4\nv 2 2 -2\nv 0 2 -2\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 0.5\nvt 0 0.5\n"
    "g floor\nusemtl paint\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\ng lamp\nusemtl glow\nf 5/1 6/2 7/3\nf 5/1 7/3 8/4\n";

void checkEqual(const Scene& a, const Scene& b) {
  REQUIRE(a.surfaces.size() == b.surfaces.size());
  for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
    const Surface &x = a.surfaces[s], &y = b.surfaces[s];
    CHECK(x.name == y.name);
    CHECK(x.family == y.family);
    const Material& m = a.materials[static_cast<std::size_t>(x.material)];
    const Material& n = b.materials[static_cast<std::size_t>(y.material)];
    CHECK(m.name == n.name);
    CHECK(m.reflectance == n.reflectance);
    CHECK(m.emission == n.emission);
    REQUIRE(x.triangles.size() == y.triangles.size());
    for (std::size_t t = 0; t < x.triangles.size(); ++t) {
      CHECK(x.triangles[t].position == y.triangles[t].position);
      CHECK(x.triangles[t].chart == y.triangles[t].chart);
      CHECK(x.triangles[t].texcoord == y.triangles[t].texcoord);
    }
  }
  CHECK(a.origin == b.origin);
  CHECK(a.extent == b.extent);
}

Scene roomFromObj() {
  const SceneFile obj("room.obj", roomObj);
  writeAll(obj.folder.path / "room.mtl", roomMtl);
  return obj.load();
}

/// The message of the error that loading a file raises.
std::string faultOf(const std::string& content, const std::string& name = "scene.glb") {
  const SceneFile file(name, content);
  try {
    file.load();
  } catch (const raster::InputError& error) {
    CHECK(std::string(error.what()).starts_with(file.path.string() + ": "));
    CHECK(!error.advice().empty());
    return error.what();
  }
  return "no error";
}

/// A scene of one triangle per entry of `used`, which are the vertices of a primitive.
template <typename Index>
Scene loadMode(int mode, const std::vector<Index>& used, int type) {
  Gltf gltf;
  const int positions = gltf.accessor(square, floatType, "VEC3", 3);
  gltf.add(
      "it",
      {{"attributes", {{"POSITION", positions}}}, {"indices", gltf.accessor(used, type, "SCALAR", 1)}, {"mode", mode}});
  return SceneFile("scene.glb", gltf.glb()).load();
}

}  // namespace

TEST_CASE("readGltf gives the surfaces of the same scene in OBJ", "[gltf]") {
  const Scene obj = roomFromObj();
  REQUIRE(obj.surfaces.size() == 2);
  checkEqual(SceneFile("room.glb", roomGltf().glb()).load(), obj);

  Gltf gltf = roomGltf();
  gltf.text["buffers"] = {{{"byteLength", gltf.bytes.size()}, {"uri", "my%20room.bin"}}};
  const SceneFile text("room.gltf", gltf.text.dump());
  writeAll(text.folder.path / "my room.bin", gltf.bytes);
  checkEqual(text.load(), obj);
}

namespace {

Gltf dracoRoom() {
  Gltf gltf = roomGltf();
  tests::compressByDraco(gltf.text, gltf.bytes, true);
  return gltf;
}
Gltf meshoptRoom(tests::MeshoptMode mode = tests::MeshoptMode::Exact) {
  Gltf gltf = roomGltf();
  tests::compressByMeshopt(gltf.text, gltf.bytes, mode);
  return gltf;
}

/// Where the data of a compressed file are: offset and size in the buffer.
std::vector<std::pair<std::size_t, std::size_t>> compressedData(const json& text) {
  std::vector<std::pair<std::size_t, std::size_t>> data;
  for (const json& view : text["bufferViews"]) {
    const json compressed = view.value(json::json_pointer("/extensions/EXT_meshopt_compression"), json());
    if (!compressed.is_null()) data.emplace_back(compressed["byteOffset"], compressed["byteLength"]);
  }
  for (const json& mesh : text["meshes"])
    for (const json& primitive : mesh["primitives"])
      if (primitive.contains("extensions")) {
        const json& view =
            text["bufferViews"][primitive["extensions"]["KHR_draco_mesh_compression"]["bufferView"].get<std::size_t>()];
        data.emplace_back(view["byteOffset"], view["byteLength"]);
      }
  return data;
}

}  // namespace

TEST_CASE("readGltf gives the surfaces of a scene whose meshes are compressed", "[gltf]") {
  const Scene obj = roomFromObj();
  checkEqual(SceneFile("room.glb", dracoRoom().glb()).load(), obj);
  checkEqual(SceneFile("room.glb", meshoptRoom().glb()).load(), obj);
}

TEST_CASE("readGltf reports compressed meshes whose data are broken", "[gltf]") {
  for (const Gltf& gltf : {dracoRoom(), meshoptRoom(), meshoptRoom(tests::MeshoptMode::Rotated)}) {
    for (const auto& [offset, size] : compressedData(gltf.text)) {
      Gltf empty = gltf;
      std::fill_n(empty.bytes.begin() + static_cast<std::ptrdiff_t>(offset), size, '\0');
      CHECK_THAT(faultOf(empty.glb()), Catch::Contains("its data are broken"));
      for (std::size_t i = offset; i < offset + size; ++i) {  // any other byte is read, or reported
        Gltf changed = gltf;
        changed.bytes[i] = static_cast<char>(changed.bytes[i] ^ 0x55);
        const std::string fault = faultOf(changed.glb());
        CHECK(!fault.empty());
      }
    }
  }
  const auto [pointer, value, problem] = GENERATE(table<std::string, json, std::string>({
      {"/bufferViews/0/extensions/EXT_meshopt_compression/byteLength", 9, "buffer view 0 is compressed with meshopt"},
      {"/bufferViews/0/extensions/EXT_meshopt_compression/byteLength", 9e9, "buffer view 0 reaches beyond"},
      {"/bufferViews/0/extensions/EXT_meshopt_compression/byteStride", 0, "its data are broken"},
      {"/bufferViews/0/extensions/EXT_meshopt_compression/byteStride", 6, "its data are broken"},
      {"/bufferViews/0/extensions/EXT_meshopt_compression/count", 100000, "its data are broken"},
      {"/bufferViews/0/extensions/EXT_meshopt_compression/filter", "OCTAHEDRAL", "its data are broken"},
      {"/bufferViews/0/extensions/EXT_meshopt_compression/buffer", 7, "buffer 7 does not exist"},
      {"/bufferViews/2/extensions/EXT_meshopt_compression/mode", "TRIANGLES", "its data are broken"},
      {"/bufferViews/2/extensions/EXT_meshopt_compression/mode", "OTHER", "its data are broken"},
  }));
  Gltf gltf = meshoptRoom();
  gltf.text[json::json_pointer(pointer)] = value;
  INFO(pointer << " = " << value);
  CHECK_THAT(faultOf(gltf.glb()), Catch::Contains(problem));
  Gltf other = dracoRoom();
  other.text["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 9;
  CHECK_THAT(faultOf(other.glb()), Catch::Contains("mesh 0 is compressed with Draco, and its data are broken"));
  other.text["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"].erase("bufferView");
  CHECK_THAT(faultOf(other.glb()), Catch::Contains("is no valid glTF"));
}

TEST_CASE("solve ends with exit code 2 for a compressed mesh whose data are broken", "[gltf][cli]") {
  const tests::Shell shell;
  Gltf gltf = dracoRoom();
  std::fill(gltf.bytes.begin(), gltf.bytes.end(), '\0');
  writeAll(shell.file("broken.glb"), gltf.glb());
  const tests::Outcome outcome = shell.run("solve broken.glb -o out");
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Catch::Contains("broken.glb: mesh 0 is compressed with Draco"));
  CHECK_FALSE(std::filesystem::exists(shell.file("out")));
}

TEST_CASE("solve gives the same elements for a scene in glTF and in OBJ", "[gltf][cli]") {
  const tests::Shell shell;
  writeAll(shell.file("room.obj"), roomObj);
  writeAll(shell.file("room.mtl"), roomMtl);
  writeAll(shell.file("binary.glb"), roomGltf().glb());
  const std::string options = " --texels 4 --resolution 32 --size 40x30 -o ";
  shell.output("solve room.obj" + options + "a");
  shell.output("solve binary.glb" + options + "b");
  const std::string elements = tests::readAll(shell.file("a/elements.csv"));
  CHECK(tests::linesOf(elements).size() > 8);
  CHECK(tests::readAll(shell.file("b/elements.csv")) == elements);
}

TEST_CASE("readGltf reads triangles, strips and fans with indices of every type", "[gltf]") {
  const Scene list = loadMode<std::uint32_t>(4, {0, 1, 2, 0, 2, 3}, intType);
  const Scene strip = loadMode<std::uint8_t>(5, {0, 1, 3, 2}, byteType);
  const Scene fan = loadMode<std::uint16_t>(6, {0, 1, 2, 3}, shortType);
  for (const Scene* scene : {&list, &strip, &fan}) {
    REQUIRE(scene->surfaces.size() == 1);
    double sum = 0;
    for (const Triangle& triangle : scene->surfaces[0].triangles) {
      CHECK(normal(triangle) == glm::dvec3(0, 1, 0));
      sum += area(triangle);
    }
    CHECK(sum == 16);
  }
}

TEST_CASE("readGltf keeps fronts outside in a mirrored node", "[gltf]") {
  Gltf gltf;
  const int positions = gltf.accessor(square, floatType, "VEC3", 3);
  const int indices = gltf.accessor(std::vector<std::uint8_t>{0, 1, 2}, byteType, "SCALAR", 1);
  const json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
  gltf.add("mirrored", primitive, {{"scale", {-1, 1, 1}}});
  gltf.text["nodes"].push_back({{"children", {0}}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}});
  gltf.text["scenes"][0]["nodes"] = {1};
  const Scene scene = SceneFile("scene.glb", gltf.glb()).load();
  const Triangle& triangle = scene.surfaces.at(0).triangles.at(0);
  CHECK(normal(triangle) == glm::dvec3(0, 1, 0));
  CHECK(area(triangle) == 32);
  CHECK(std::count(triangle.position.begin(), triangle.position.end(), glm::dvec3(2, 0, -8)) == 1);
}

TEST_CASE("readGltf keeps the tree of nodes and their names", "[gltf]") {
  Gltf gltf;
  const int positions = gltf.accessor(square, floatType, "VEC3", 3);
  const int indices = gltf.accessor(std::vector<std::uint8_t>{0, 1, 2}, byteType, "SCALAR", 1);
  const json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
  gltf.add("chair", primitive);
  gltf.add("chair", primitive, {{"translation", {9, 0, 0}}});
  gltf.text["nodes"].push_back({{"children", {0, 3}}, {"name", "my room"}});
  gltf.text["nodes"].push_back({{"children", {1}}});
  gltf.text["scenes"][0]["nodes"] = {2};
  const Scene scene = SceneFile("scene.glb", gltf.glb()).load();
  const std::vector<std::string> names{"my room", "chair", "node-3", "chair~2"};
  const std::vector<std::optional<int>> parents{{}, 0, 0, 2};
  REQUIRE(scene.objects.size() == 4);
  for (std::size_t o = 0; o < 4; ++o) {
    CHECK(scene.objects[o].name == names[o]);
    CHECK(scene.objects[o].parent == parents[o]);
  }
  REQUIRE(scene.surfaces.size() == 2);
  CHECK(scene.surfaces[0].object == 1);
  CHECK(scene.surfaces[1].object == 3);
}

TEST_CASE("gltfMaterials scales the factor by the texture", "[gltf]") {
  Image image{2, 1, {glm::dvec3(1.0), glm::dvec3(decodeSrgb(51 / 255.0))}};
  Gltf gltf = roomGltf();
  const SceneFile folder("unused", "");
  writePng(folder.folder.path / "a b.png", image);
  const Image decoded = readImage(folder.folder.path / "a b.png");
  gltf.text["images"] = {
      {{"bufferView", gltf.view(tests::readAll(folder.folder.path / "a b.png"))}, {"mimeType", "image/png"}},
      {{"uri", "a%20b.png"}},
      {{"uri", "missing.png"}}};
  gltf.text["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
  gltf.text["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                                       {"baseColorFactor", {0.5, 1, 0.25, 1}}};
  gltf.text["materials"][1]["emissiveTexture"] = {{"index", 1}};
  writeAll(folder.folder.path / "scene.glb", gltf.glb());
  const Scene scene = loadScene(folder.folder.path / "scene.glb", {.emission = EmissionUnit::Radiance});
  CAPTURE(scene.warnings);
  REQUIRE(scene.images.size() == 2);
  for (const Image& found : scene.images) CHECK(found.pixels == decoded.pixels);
  CHECK(scene.materials.at(0).reflectance == glm::dvec3(0.5, 0.9999, 0.25));
  CHECK(scene.materials[0].reflectanceMap == 0);
  CHECK(scene.materials.at(1).emission == glm::dvec3(8, 4, 2) * radiosityPerUnit(EmissionUnit::Radiance));
  CHECK(scene.materials[1].emissionMap == 1);

  gltf.text["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 2;
  writeAll(folder.folder.path / "scene.glb", gltf.glb());
  const Scene without = loadScene(folder.folder.path / "scene.glb");
  CHECK(without.materials.at(0).reflectance == glm::dvec3(0.5));
  CHECK(std::any_of(without.warnings.begin(), without.warnings.end(),
                    [](const std::string& warning) { return warning.find("missing.png") != std::string::npos; }));
}

TEST_CASE("readGltf keeps one image of a file or a range of bytes that several images name", "[gltf]") {
  const SceneFile folder("unused", "");
  writePng(folder.folder.path / "a.png", {2, 1, {glm::dvec3(1.0), glm::dvec3(0.5)}});
  Gltf gltf = roomGltf();
  const int view = gltf.view(tests::readAll(folder.folder.path / "a.png"));
  const json file = {{"uri", "a.png"}}, range = {{"bufferView", view}, {"mimeType", "image/png"}};
  gltf.text["images"] = {file, range, file, range};
  gltf.text["textures"] = {{{"source", 3}}, {{"source", 2}}};
  gltf.text["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 1}};
  gltf.text["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 1}};
  gltf.text["materials"][1]["emissiveTexture"] = {{"index", 0}};
  writeAll(folder.folder.path / "scene.glb", gltf.glb());
  CHECK(readGltf(folder.folder.path / "scene.glb").images.size() == 2);
  const Scene scene = loadScene(folder.folder.path / "scene.glb");
  CHECK(scene.images.size() == 2);
  CHECK(scene.materials.at(0).reflectanceMap == scene.materials.at(1).reflectanceMap);
  CHECK(scene.materials[0].reflectanceMap != scene.materials[1].emissionMap);
}

TEST_CASE("loadScene refuses a glTF file whose nodes repeat more triangles than fit into memory", "[gltf]") {
  Gltf gltf;
  const int positions = gltf.accessor(square, floatType, "VEC3", 3);
  const int indices = gltf.accessor(std::vector<std::uint8_t>(30000, 1), byteType, "SCALAR", 1);
  json primitives;
  for (int p = 0; p < 3000; ++p)
    primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  gltf.text["meshes"] = {{{"primitives", primitives}}};
  for (int n = 0; n < 3000; ++n) {
    gltf.text["nodes"].push_back({{"mesh", 0}});
    gltf.text["scenes"][0]["nodes"].push_back(n);
  }
  CHECK_THAT(faultOf(gltf.glb()), Catch::Contains("the scene of 90000000000 triangles, with those that nodes repeat, "
                                                  "takes about 9.9e+04 GB of memory"));
}

TEST_CASE("loadScene reads 40,000 nodes of one name", "[gltf]") {
  Gltf gltf;
  const json primitive = {{"attributes", {{"POSITION", gltf.accessor(square, floatType, "VEC3", 3)}}}, {"mode", 6}};
  gltf.text["meshes"] = {{{"primitives", {primitive}}}};
  constexpr int nodes = 40000;
  for (int n = 0; n < nodes; ++n) {
    gltf.text["nodes"].push_back({{"mesh", 0}, {"name", "node"}, {"translation", {0, n, 0}}});
    gltf.text["scenes"][0]["nodes"].push_back(n);
  }
  const SceneFile file("scene.glb", gltf.glb());
  CHECK(file.load().surfaces.back().name == "node~40000");
}

TEST_CASE("readGltf reads the camera", "[gltf]") {
  Gltf gltf = roomGltf();
  gltf.text["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  gltf.text["nodes"].push_back({{"camera", 0}, {"translation", {1, 2, 3}}});
  gltf.text["scenes"][0]["nodes"].push_back(2);
  const Scene scene = SceneFile("scene.glb", gltf.glb()).load();
  REQUIRE(scene.camera);
  CHECK(scene.camera->eye == glm::dvec3(1, 2, 3));
  CHECK(scene.camera->lookAt == glm::dvec3(1, 2, 2));
  CHECK(scene.camera->up == glm::dvec3(0, 1, 0));
  CHECK(scene.camera->fov == Approx(57.29577951));
  CHECK(scene.warnings.empty());
  CHECK(!SceneFile("room.glb", roomGltf().glb()).load().camera);
}

TEST_CASE("addLights makes lamps and suns of the lights of glTF, at the places of their nodes", "[gltf]") {
  Gltf gltf = roomGltf();
  gltf.text["extensionsUsed"].push_back("KHR_lights_punctual");
  gltf.text["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 683}, {"color", {1, 0.5, 0.25}}},
      {{"type", "spot"},
       {"name", "beam"},
       {"intensity", 1366},
       {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
      {{"type", "directional"}, {"intensity", 6830}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}};
  const auto addNode = [&](json node, int light) {
    node["extensions"]["KHR_lights_punctual"]["light"] = light;
    gltf.text["scenes"][0]["nodes"].push_back(gltf.text["nodes"].size());
    gltf.text["nodes"].push_back(node);
  };
  const double half = std::sqrt(0.5);
  addNode({{"name", "bulb"}, {"translation", {1, 2, 3}}}, 0);
  addNode({{"translation", {0, 1, 0}}, {"rotation", {-half, 0, 0, half}}, {"scale", {2, 2, 2}}}, 1);  // looks down
  addNode({{"rotation", {-half, 0, 0, half}}}, 2);
  addNode({{"name", "bulb"}}, 3);
  const SceneFile file("scene.glb", gltf.glb());
  const Scene scene = file.load();
  CHECK(scene.warnings.empty());
  CHECK(scene.photometricLights == 4);
  REQUIRE(scene.lamps.size() == 3);
  CHECK(scene.lamps[0].name == "bulb");
  CHECK(scene.lamps[0].position == glm::dvec3(1, 2, 3));
  CHECK(scene.lamps[0].intensity == glm::dvec3(1, 0.5, 0.25));
  CHECK(!scene.lamps[0].cone);
  CHECK(scene.lamps[1].name == "beam");
  CHECK(scene.lamps[1].intensity == glm::dvec3(2));
  REQUIRE(scene.lamps[1].cone);
  CHECK(glm::distance(scene.lamps[1].cone->axis, glm::dvec3(0, -1, 0)) < 1e-12);
  CHECK(scene.lamps[1].cone->innerCosine == Approx(std::cos(0.25)));
  CHECK(scene.lamps[1].cone->outerCosine == Approx(std::cos(0.5)));
  CHECK(scene.lamps[2].name == "bulb~2");
  CHECK(scene.lamps[2].cone->innerCosine == Approx(std::cos(0.5) + 0.001));
  REQUIRE(scene.outside.suns.size() == 1);
  CHECK(glm::distance(scene.outside.suns[0].towards, glm::dvec3(0, 1, 0)) < 1e-12);
  CHECK(scene.outside.suns[0].irradiance == glm::dvec3(10));
  CHECK(file.load({.lumensPerWatt = 1}).lamps[0].intensity == glm::dvec3(683, 341.5, 170.75));

  gltf.text["extensions"]["KHR_lights_punctual"]["lights"][1]["spot"]["outerConeAngle"] = 1.6;
  CHECK_THAT(faultOf(gltf.glb()), Catch::Contains("`beam` has cone angles out of range"));
  gltf.text["nodes"].back()["extensions"]["KHR_lights_punctual"]["light"] = 4;
  gltf.text["extensions"]["KHR_lights_punctual"]["lights"][1]["spot"]["outerConeAngle"] = 0.5;
  CHECK_THAT(faultOf(gltf.glb()), Catch::Contains("light 4 does not exist: there are 4"));
}

TEST_CASE("loadScene names each glTF material that lets light through", "[gltf]") {
  const auto [pointer, value, way] = GENERATE(table<std::string, std::string, std::string>({
      {"/materials/0/alphaMode", "\"BLEND\"", "alphaMode BLEND"},
      {"/materials/0/extensions", R"({"KHR_materials_transmission": {"transmissionFactor": 1}})", "transmission"},
  }));
  Gltf gltf = roomGltf();
  gltf.text[json::json_pointer(pointer)] = json::parse(value);
  const Scene scene = SceneFile("scene.glb", gltf.glb()).load();
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Catch::Contains("'paint'") && Catch::Contains(way) && Catch::Contains("opaque"));
}

TEST_CASE("readGltf reports each fault with the file and advice", "[gltf]") {
  const auto [pointer, value, problem] = GENERATE(table<std::string, std::string, std::string>({
      {"/asset/version", "[]", "no valid glTF"},
      {"/bufferViews/0/byteLength", "100000", "buffer view 0 reaches beyond its buffer"},
      {"/bufferViews/0/byteOffset", "18446744073709551615", "buffer view 0 reaches beyond its buffer"},
      {"/bufferViews/0/buffer", "7", "buffer 7 does not exist"},
      {"/bufferViews/0/byteStride", "4", "stride"},
      {"/accessors/0/count", "5", "reaches beyond its buffer view"},
      {"/accessors/0/count", "1000000000000", "reaches beyond its buffer view"},
      {"/accessors/0/byteOffset", "4", "reaches beyond its buffer view"},
      {"/accessors/0/bufferView", "9", "buffer view 9 does not exist"},
      {"/accessors/0/type", R"("VEC2")", "values of a wrong type"},
      {"/accessors/2/count", "5", "no multiple of 3"},
      {"/accessors/2/componentType", "5126", "component type"},
      {"/accessors/0/sparse",
       R"({"count": 4, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})",
       "accessor 0 is sparse, and replaces a value that it lacks"},
      {"/meshes/0/primitives/0/attributes/POSITION", "11", "accessor 11 does not exist"},
      {"/meshes/0/primitives/0/indices", "0", "indices have the component type"},
      {"/meshes/0/primitives/0/material", "5", "material 5 does not exist"},
      {"/nodes/0/mesh", "4", "mesh 4 does not exist"},
      {"/nodes/0/children", "[0]", "several parents"},
      {"/nodes/1/rotation", "[0, 0, 0, 0]", "rotation"},
      {"/nodes/1/scale", "[1e300, 1, 1]", "1e18"},
      {"/scenes/0/nodes", "[3]", "node 3 does not exist"},
      {"/scenes/0/nodes", "[]", "no face"},
      {"/scene", "2", "scene 2 does not exist"},
      {"/materials/1/emissiveFactor", "[-1, 0, 0]", "negative"},
      {"/materials/1/emissiveFactor", "[1e35, 0, 0]", "1e30"},
      {"/materials/0/pbrMetallicRoughness/baseColorTexture", R"({"index": 0})", "texture 0 does not exist"},
      {"/extensionsRequired", R"(["KHR_texture_basisu"])", "KHR_texture_basisu"},
      {"/images", R"([{"bufferView": 44}])", "no valid glTF"},
  }));
  Gltf gltf = roomGltf();
  gltf.text[json::json_pointer(pointer)] = json::parse(value);
  INFO(pointer << " = " << value);
  CHECK_THAT(faultOf(gltf.glb()), Catch::Contains(problem));
}

TEST_CASE("readGltf rejects values that are not finite and indices out of range", "[gltf]") {
  Gltf gltf = roomGltf();
  const auto write = [&gltf](std::size_t offset, auto value) {
    Gltf changed = gltf;
    std::memcpy(changed.bytes.data() + offset, &value, sizeof value);
    return changed.glb();
  };
  const std::size_t texcoords = gltf.text["bufferViews"][1]["byteOffset"],
                    indices = gltf.text["bufferViews"][2]["byteOffset"];
  CHECK_THAT(faultOf(write(0, NAN)), Catch::Contains("vertex 0 has a coordinate that is not finite"));
  CHECK_THAT(faultOf(write(16, INFINITY)), Catch::Contains("vertex 1"));
  CHECK_THAT(faultOf(write(4, 1e20f)), Catch::Contains("1e18"));
  CHECK_THAT(faultOf(write(texcoords, NAN)), Catch::Contains("texture coordinate"));
  CHECK_THAT(faultOf(write(indices, std::uint16_t{4})),
             Catch::Contains("index 4 is out of range: there are 4 vertices"));
}

TEST_CASE("readGltf reads no file outside the folder of the scene", "[gltf]") {
  const Gltf gltf = roomGltf();
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "inner");
  for (const char* file : {"out.bin", "inner/in.bin"}) writeAll(folder.path / file, gltf.bytes);
  const auto load = [&](const std::string& uri) {
    json text = gltf.text;
    text["buffers"] = {{{"byteLength", gltf.bytes.size()}, {"uri", uri}}};
    writeAll(folder.path / "inner/scene.gltf", text.dump());
    return loadScene(folder.path / "inner/scene.gltf");
  };
  CHECK(load("in.bin").surfaces.size() == 2);
  CHECK(load("./in.bin").surfaces.size() == 2);
  for (const std::string& uri :
       {std::string("../out.bin"), std::string("x/../../out.bin"), std::string("missing.bin"),
        std::string("http://example.org/a.bin"), (folder.path / "out.bin").string(), std::string("$(echo in).bin")}) {
    INFO(uri);
    CHECK_THROWS_WITH(load(uri), Catch::Contains("names the file") && Catch::Contains("in its folder"));
  }
}

TEST_CASE("readGltf reports every truncated file, and survives every changed byte", "[gltf]") {
  const std::string whole = roomGltf().glb();
  const SceneFile file("scene.glb", whole);
  REQUIRE(file.load().surfaces.size() == 2);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    writeAll(file.path, whole.substr(0, size));
    INFO(size);
    CHECK_THROWS_AS(file.load(), raster::InputError);
  }
  std::size_t faults = 0;
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int flipped : {0x01, 0x10, 0x80, 0xff}) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ flipped);
      writeAll(file.path, changed);
      try {
        file.load();
      } catch (const raster::InputError&) {
        ++faults;
      }
    }
  CHECK(faults > whole.size());
}
