/// makeGltfModel and writeGlb: the files are parsed by the tests.
#include "radiosity/textures/gltf_scene.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "radiosity/textures/lit_scene.h"
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

/// A room far from zero: two surfaces with textures, two that are Gouraud shaded.
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
};

glm::dvec3 vectorOf(const json& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

TEST_CASE("writeLitScene writes scene.glb with an unlit object per surface", "[gltf]") {
  const TemporaryFolder folder;
  const FarRoom room;
  const LitScene lit = room.lit();
  REQUIRE(writeLitScene(folder.path, lit, room.view, room.discretization, room.radiosity).empty());
  const Glb glb = parseGlb(readAll(folder.path / "scene.glb"));
  const json& gltf = glb.description;
  CHECK(gltf["asset"]["version"] == "2.0");
  CHECK(gltf["extensionsUsed"] == json({"KHR_materials_unlit"}));
  REQUIRE(gltf["nodes"].size() == 5);  // four surfaces and the camera
  const std::vector<std::string> names{"a_b", "wall_1", "bright", "dark"};
  for (std::size_t s = 0; s < 4; ++s) {
    const json &node = gltf["nodes"][s], &mesh = gltf["meshes"][node["mesh"].get<std::size_t>()];
    CHECK(node["name"] == names[s]);
    CHECK(mesh["name"] == names[s]);
    const json& primitive = mesh["primitives"][0];
    const json &attributes = primitive["attributes"], &material = gltf["materials"][primitive["material"].get<int>()];
    CHECK(material["extensions"].contains("KHR_materials_unlit"));
    const bool isGouraud = s >= 2;
    CHECK(attributes.contains("COLOR_0") == isGouraud);
    CHECK(material["pbrMetallicRoughness"].contains("baseColorTexture") == !isGouraud);

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
        if (!isGouraud) continue;
        const auto colours = accessorValues<glm::vec3>(glb, attributes["COLOR_0"]);
        CHECK(colours[corner].x == Approx(decodeSrgb((*triangle.cornerColor)[k].x)));
      }
  }
}

TEST_CASE("writeLitScene puts the display textures into scene.glb, with a linear filter", "[gltf]") {
  const TemporaryFolder folder;
  const FarRoom room;
  REQUIRE(writeLitScene(folder.path, room.lit(), room.view, room.discretization, room.radiosity).empty());
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

TEST_CASE("makeGltfModel makes one object per material of scenes with very many surfaces", "[gltf]") {
  const FarRoom room;
  const LitScene lit = room.lit();
  const GltfModel model = makeGltfModel(lit.scene, room.view, {}, 3);
  REQUIRE(model.objects.size() == 3);  // two textures, and the material of both Gouraud shaded surfaces
  CHECK(model.objects[0].name == "a_b");
  CHECK(model.objects[2].name == "gouraud");
  CHECK(model.objects[2].corners.size() == 12);
  CHECK(model.objects[2].colours.size() == model.objects[2].positions.size());
}

TEST_CASE("writeGlb warns and writes no file where the format cannot hold the model", "[gltf]") {
  const TemporaryFolder folder;
  const FarRoom room;
  const GltfModel model = makeGltfModel(room.lit().scene, room.view, std::vector(4, std::vector<unsigned char>(5000)));
  CHECK_FALSE(writeGlb(folder.path / "fits.glb", model));
  const auto size = std::filesystem::file_size(folder.path / "fits.glb");
  CHECK(size > 20000);
  const std::optional<std::string> warning = writeGlb(folder.path / "large.glb", model, size - 1);
  REQUIRE(warning);
  CHECK(warning->starts_with("large.glb is not written"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "large.glb"));
  CHECK_THROWS_AS(writeGlb(folder.path / "absent" / "scene.glb", model), raster::InputError);
}
