/// divideByMaterials: reflectance and emission from cell data of VTK and emittances of View3D.
#include "radiosity/scene/face_materials.h"

#include <catch2/catch.hpp>

#include "radiosity/meshes/vtu_file.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Three squares side by side.
PolygonMesh squares() {
  PolygonMesh mesh{.sections = {{0, ""}}, .objects = {{"default"}}};
  const std::filesystem::path file = "hand";
  for (std::uint32_t s = 0; s < 3; ++s) {
    for (const glm::dvec2& corner : {glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}})
      mesh.positions.emplace_back(corner.x + 2 * s, corner.y, 0);
    addPolygon(mesh, std::vector{4 * s, 4 * s + 1, 4 * s + 2, 4 * s + 3}, {file});
  }
  return mesh;
}

Scene sceneWith(const std::vector<FaceArray>& arrays, const SceneSettings& settings) {
  const TemporaryFolder folder;
  writeVtu(folder.path / "a.vtu", squares(), arrays);
  return loadScene(folder.path / "a.vtu", settings);
}

const Material& materialOf(const Scene& scene, std::size_t surface) {
  return scene.materials[static_cast<std::size_t>(scene.surfaces[surface].material)];
}

}  // namespace

TEST_CASE("loadScene takes reflectance and emission of facets from cell data", "[face_materials]") {
  const std::vector<FaceArray> arrays{{"rho", 1, {0.25, 0.5, 0.75}}, {"power", 3, {0, 0, 0, 1, 2, 3, 0, 0, 0}}};
  const Scene scene = sceneWith(arrays, {.facets = true, .cellReflectance = "rho", .cellEmission = "power"});
  REQUIRE(scene.surfaces.size() == 3);
  for (std::size_t s = 0; s < 3; ++s) {
    CHECK(scene.surfaces[s].name == std::to_string(s));
    CHECK(materialOf(scene, s).reflectance == glm::dvec3(arrays[0].values[s]));
    CHECK(materialOf(scene, s).emission == (s == 1 ? glm::dvec3(1, 2, 3) : glm::dvec3(0)));
  }
}

TEST_CASE("loadScene divides surfaces by cell data without facets", "[face_materials]") {
  const Scene scene = sceneWith({{"e", 1, {1, 0, 1}}}, {.emission = EmissionUnit::Radiance, .cellEmission = "e"});
  CHECK(scene.materials.size() == 2);
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const bool isLit = scene.surfaces[s].triangles.front().polygon != 1;
    CHECK(materialOf(scene, s).emission == glm::dvec3(isLit ? radiosityPerUnit(EmissionUnit::Radiance) : 0));
    CHECK(materialOf(scene, s).reflectance == glm::dvec3(0.5));
  }
}

TEST_CASE("loadScene lowers and refuses cell data that are no reflectance or emission", "[face_materials]") {
  const Scene scene = sceneWith({{"rho", 1, {0.5, 1, 1.5}}}, {.facets = true, .cellReflectance = "rho"});
  CHECK(materialOf(scene, 0).reflectance == glm::dvec3(0.5));
  CHECK(materialOf(scene, 1).reflectance == glm::dvec3(0.9999));
  CHECK(materialOf(scene, 2).reflectance == glm::dvec3(0.9999));
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings.front(), Catch::StartsWith("face 2, and perhaps others"));
  CHECK_THROWS_WITH(sceneWith({{"rho", 1, {0.5, 0.5, -0.5}}}, {.cellReflectance = "rho"}),
                    Catch::Contains("face 3 has a negative reflectance"));
  CHECK_THROWS_WITH(sceneWith({{"rho", 1, {0, 0, 0}}}, {.cellEmission = "power"}), Catch::Contains("`power`"));
  CHECK_THROWS_WITH(loadScene(HEMITEX_DATA "/cornell-box.obj", {.cellEmission = "e"}),
                    Catch::Contains("has no cell data"));
}

TEST_CASE("loadScene reads emittances of View3D as reflectances", "[face_materials]") {
  const TemporaryFolder folder;
  tests::writeAll(folder.path / "a.vs3",
                  "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nV 5 2 0 0\nV 6 3 0 0\nV 7 3 1 0\nV 8 2 1 0\n"
                  "S 1 1 2 3 4 0 0 0.75 wall\nO 2 5 6 7 8\nS 3 4 3 2 1 0 0 1 lamp\nEnd of data\n");
  const Scene scene = loadScene(folder.path / "a.vs3", {.facets = true});
  REQUIRE(scene.surfaces.size() == 3);
  CHECK(materialOf(scene, 0).reflectance == glm::dvec3(0.25));
  CHECK(materialOf(scene, 1).reflectance == glm::dvec3(0));
  CHECK(materialOf(scene, 2).reflectance == glm::dvec3(0));
  tests::writeAll(folder.path / "b.vs3", "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nS 1 1 2 3 0 0 0 1.5 wall\n");
  CHECK_THROWS_WITH(loadScene(folder.path / "b.vs3"), Catch::Contains(":5: an emittance is from 0 to 1"));
}
