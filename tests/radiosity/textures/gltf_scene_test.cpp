/// makeGltfModel and writeGlb: the files are parsed by the tests.
#include "radiosity/textures/gltf_scene.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "radiosity/scene/load_scene.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/input_error.h"
#include "tests/support/glb.h"
#include "tests/support/picture_scenes.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using nlohmann::json;

namespace {

/// A room far from zero: two surfaces with filtered textures, two that are Gouraud shaded.
struct FarRoom {
  Scene scene = sceneOf({parallelogram("a b", {5e6, 7, 1}, {1, 0, 0}, {0, 1, 0}),
                         parallelogram("wall#1", {5e6, 7, 1}, {0, 2, 0}, {0, 0, 3}),
                         parallelogram("bright", {5e6 + 3, 7, 1}, {1, 0, 0}, {0, 1, 0}),
                         parallelogram("dark", {5e6 + 4, 7, 1}, {1, 0, 0}, {0, 1, 0})});
  Discretization discretization;
  std::vector<glm::dvec3> radiosity;
  PictureView view{{{5e6 + 2, 8, 9}, {5e6, 7, 1}, {0, 1, 0}, 40}, 1.5};

  FarRoom() {
    addGrid(discretization, 4, 2);
    addGrid(discretization, 2, 2);
    for (int s = 0; s < 2; ++s) addGrid(discretization, 1, 1);
    for (std::size_t e = 0; e < 14; ++e) radiosity.emplace_back(0.05 * static_cast<double>(e + 1));
  }

  LitScene lit() const {
    return makeLitScene(scene, discretization, layOutTextures(scene, discretization, {}), radiosity, 1,
                        TextureFilter::Bicubic);
  }

  /// Returns warnings.
  std::vector<std::string> write(const std::filesystem::path& folder) const {
    const LitScene lit = this->lit();
    return writeLitScene(folder, lit, view, radiosityTextures(discretization, lit.layout, radiosity));
  }
};

glm::dvec3 vectorOf(const json& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

TEST_CASE("writeLitScene writes scene.glb with an unlit node per surface without object", "[gltf]") {
  const TemporaryFolder folder;
  const FarRoom room;
  const LitScene lit = room.lit();
  REQUIRE(room.write(folder.path).empty());
  const Glb glb = parseGlb(readAll(folder.path / "scene.glb"));
  const json& gltf = glb.description;
  CHECK(gltf["asset"]["version"] == "2.0");
  CHECK(gltf["extensionsUsed"] == json({"KHR_materials_unlit"}));
  REQUIRE(gltf["nodes"].size() == 5);  // four surfaces and the camera
  const std::vector<std::string> names{"a b", "wall#1", "bright", "dark"};
  for (std::size_t s = 0; s < 4; ++s) {
    const json &node = gltf["nodes"][s], &mesh = gltf["meshes"][node["mesh"].get<std::size_t>()];
    CHECK(node["name"] == names[s]);
    CHECK(mesh["name"] == names[s]);
    const json& primitive = mesh["primitives"][0];
    const json &attributes = primitive["attributes"], &material = gltf["materials"][primitive["material"].get<int>()];
    CHECK(material["extensions"].contains("KHR_materials_unlit"));
    CHECK(material["pbrMetallicRoughness"]["baseColorTexture"]["index"] == s);

    // The triangles keep their corners in space and in the texture, where glTF counts v from the top.
    const auto corners = accessorValues<std::uint32_t>(glb, primitive["indices"]);
    const auto positions = accessorValues<glm::vec3>(glb, attributes["POSITION"]);
    const auto texcoords = accessorValues<glm::vec2>(glb, attributes["TEXCOORD_0"]);
    REQUIRE(corners.size() == 6);
    CHECK(positions.size() == 4);  // corners of the diagonal are shared; one element has one colour
    for (std::size_t t = 0; t < 2; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Triangle& triangle = lit.scene.surfaces[s].triangles[t];
        const std::uint32_t corner = corners[3 * t + k];
        const glm::dvec3 position = glm::dvec3(positions[corner]) + vectorOf(node["translation"]);
        CHECK(glm::distance(position, triangle.position[k]) < 1e-6);  // in binary32 without translation 0.25
        CHECK(texcoords[corner].x == Approx(triangle.texcoord[k].x).margin(1e-7));
        CHECK(texcoords[corner].y == Approx(1 - triangle.texcoord[k].y).margin(1e-7));
      }
  }
}

TEST_CASE("writeLitScene puts the display textures into scene.glb, with a linear filter", "[gltf]") {
  const TemporaryFolder folder;
  const FarRoom room;
  REQUIRE(room.write(folder.path).empty());
  const Glb glb = parseGlb(readAll(folder.path / "scene.glb"));
  REQUIRE(glb.description["images"].size() == 4);
  for (const json& image : glb.description["images"]) {
    CHECK(image["mimeType"] == "image/png");
    CHECK(viewBytes(glb, image["bufferView"]) == readAll(folder.path / (image["name"].get<std::string>() + ".png")));
  }
  for (const json& texture : glb.description["textures"]) {
    const json& sampler = glb.description["samplers"][texture["sampler"].get<std::size_t>()];
    CHECK(sampler["magFilter"] == 9729);  // LINEAR
    CHECK(sampler["minFilter"] == 9987);  // LINEAR_MIPMAP_LINEAR
  }
}

TEST_CASE("makeGltfModel places the camera of the view", "[gltf]") {
  const FarRoom room;
  const GltfCamera camera = makeGltfModel(room.lit().scene, room.view, {}).camera;
  CHECK(camera.fov == Approx(40 * std::numbers::pi / 180));
  CHECK(camera.aspect == 1.5);
  const glm::dvec3 eye(camera.toWorld * glm::dvec4(0, 0, 0, 1)), ahead(camera.toWorld * glm::dvec4(0, 0, -1, 1));
  CHECK(eye == room.view.camera.eye);
  CHECK(glm::distance(ahead - eye, glm::normalize(room.view.camera.lookAt - eye)) < 1e-9);
  const glm::dvec3 up(camera.toWorld * glm::dvec4(0, 1, 0, 0)), right(camera.toWorld * glm::dvec4(1, 0, 0, 0));
  CHECK(up.y > 0);
  CHECK(glm::distance(glm::cross(right, up), glm::dvec3(camera.toWorld * glm::dvec4(0, 0, 1, 0))) < 1e-12);
  for (const Surface& surface : room.scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& corner : triangle.position) {
        const double distance = glm::dot(corner - eye, ahead - eye);
        CHECK((distance > camera.near && distance < camera.far));
      }
}

TEST_CASE("makeGltfModel turns a scene with z up upright, and scales it to metres", "[gltf]") {
  FarRoom room;
  room.view.up = 2;
  room.view.metresPerUnit = 0.001;
  const GltfModel model = makeGltfModel(room.lit().scene, room.view, {});
  const glm::dvec4 place = model.toGltf * glm::dvec4(1000, 2000, 3000, 1);
  CHECK(glm::distance(place, glm::dvec4(1, 3, -2, 1)) < 1e-12);
  CHECK(glm::determinant(glm::dmat3(model.toGltf)) == Approx(1e-9));  // no mirror
  CHECK(model.camera.near == Approx(1e-6 * room.lit().scene.extent));

  // What is read again is in the coordinates of glTF.
  const TemporaryFolder folder;
  room.write(folder.path);
  const Scene read = loadScene(folder.path / "scene.glb");
  const glm::dvec3 corner = room.scene.surfaces[0].triangles[0].position[0],
                   found = read.surfaces[0].triangles[0].position[0];
  CHECK(glm::distance(found, 0.001 * glm::dvec3(corner.x, corner.z, -corner.y)) < 1e-3 * 1e-3);
  REQUIRE(read.camera);
  CHECK(glm::normalize(read.camera->up).z < -0.9);  // the y axis of the room
}

TEST_CASE("writeLitScene keeps the objects of the scene as a tree of nodes, with a primitive per material", "[gltf]") {
  const TemporaryFolder folder;
  FarRoom room;
  room.scene.materials = {Material{.name = "plaster"}, Material{.name = "glass"}};
  room.scene.objects = {{"house"}, {"empty"}, {"storey", 0}, {"wall", 2}, {"lamp"}};
  const std::array objects{3, 3, 3, 4};
  for (std::size_t s = 0; s < 4; ++s) room.scene.surfaces[s].object = objects[s];
  room.scene.surfaces[3].material = 1;
  REQUIRE(room.write(folder.path).empty());
  const json gltf = parseGlb(readAll(folder.path / "scene.glb")).description;
  REQUIRE(gltf["nodes"].size() == 5);
  const std::vector<std::string> names{"wall", "lamp", "storey", "house", "camera"};
  for (std::size_t n = 0; n < 5; ++n) CHECK(gltf["nodes"][n]["name"] == names[n]);
  CHECK(gltf["scenes"][0]["nodes"] == json({1, 3, 4}));
  CHECK(gltf["nodes"][3]["children"] == json({2}));
  CHECK(gltf["nodes"][2]["children"] == json({0}));
  for (const std::size_t node : {0, 2}) CHECK_FALSE(gltf["nodes"][node].contains("translation"));
  for (const std::size_t node : {1, 3}) CHECK(gltf["nodes"][node]["translation"][0] == room.lit().scene.origin.x);
  CHECK(gltf["meshes"].size() == 2);
  const std::vector<std::string> materials{"plaster/a_b", "plaster/wall_1", "plaster/bright"};
  const json& wall = gltf["meshes"][0]["primitives"];
  REQUIRE(wall.size() == 3);
  for (std::size_t p = 0; p < 3; ++p)
    CHECK(gltf["materials"][wall[p]["material"].get<std::size_t>()]["name"] == materials[p]);
  REQUIRE(gltf["meshes"][1]["primitives"].size() == 1);
  CHECK(gltf["materials"][gltf["meshes"][1]["primitives"][0]["material"].get<std::size_t>()]["name"] == "glass");
}

TEST_CASE("litParts makes a part per object and material, or per material of scenes with very many parts", "[gltf]") {
  FarRoom room;
  room.scene.objects = {{"a"}, {"b"}};
  for (std::size_t s = 0; s < 4; ++s) room.scene.surfaces[s].object = static_cast<int>(s % 2);
  const TextureLayout shared = layOutTextures(room.scene, room.discretization, {}, 0);
  REQUIRE(shared.names.size() == 3);  // of the Gouraud shaded surfaces, and of two grids
  const Scene lit =
      makeLitScene(room.scene, room.discretization, shared, room.radiosity, 1, TextureFilter::Bicubic).scene;
  const auto surfacesOf = [](const std::vector<LitPart>& parts) {
    std::vector<std::vector<std::uint32_t>> surfaces;
    for (const LitPart& part : parts) surfaces.push_back(part.surfaces);
    return surfaces;
  };
  CHECK(surfacesOf(litParts(lit)) == std::vector<std::vector<std::uint32_t>>{{0}, {2}, {1}, {3}});
  CHECK(surfacesOf(litParts(lit, 3)) == std::vector<std::vector<std::uint32_t>>{{0}, {1}, {2, 3}});
  const GltfModel model = makeGltfModel(lit, room.view, {}, 3);
  REQUIRE(model.objects.size() == 3);
  CHECK(model.objects[0].name == lit.materials[0].name);
  CHECK(model.objects[2].primitives.at(0).corners.size() == 12);
}

TEST_CASE("writeGlb warns and writes no file where the format cannot hold the model", "[gltf]") {
  const TemporaryFolder folder;
  const FarRoom room;
  const GltfModel model =
      makeGltfModel(room.lit().scene, room.view, std::vector(4, GltfTexture{"t", std::vector<unsigned char>(5000)}));
  CHECK_FALSE(writeGlb(folder.path / "fits.glb", model));
  const auto size = std::filesystem::file_size(folder.path / "fits.glb");
  CHECK(size > 20000);
  const std::optional<std::string> warning = writeGlb(folder.path / "large.glb", model, size - 1);
  REQUIRE(warning);
  CHECK(warning->starts_with("large.glb is not written"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "large.glb"));
  CHECK_THROWS_AS(writeGlb(folder.path / "absent" / "scene.glb", model), raster::InputError);
}
