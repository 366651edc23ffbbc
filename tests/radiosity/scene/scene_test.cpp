// Scenes from OBJ files and their materials, and repairs with a warning.
#include "radiosity/scene/scene.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <set>

#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Files of a scene, removed after the test.
class SceneFiles {
 public:
  explicit SceneFiles(const std::string& obj, const std::string& mtl = {}) {
    write("scene.obj", obj);
    if (!mtl.empty()) write("scene.mtl", mtl);
  }
  std::filesystem::path path(const std::string& name) const { return folder_.path / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  Scene load(const SceneSettings& settings = {}) const { return loadScene(path("scene.obj"), settings); }

 private:
  TemporaryFolder folder_;
};

Scene load(const std::string& obj, const SceneSettings& settings = {}) { return SceneFiles(obj).load(settings); }

/// A scene of one triangle with a material defined by `statements`.
Scene loadMaterial(const std::string& statements, const SceneSettings& settings = {}) {
  return SceneFiles("mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n",
                    "newmtl paint\n" + statements)
      .load(settings);
}

const std::string cubeVertices =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string cubeFaces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::vector<std::string> namesOf(const Scene& scene) {
  std::vector<std::string> names;
  for (const Surface& surface : scene.surfaces) names.push_back(surface.name);
  return names;
}

double totalArea(const Scene& scene) {
  double sum = 0;
  for (const Surface& surface : scene.surfaces) {
    for (const Triangle& triangle : surface.triangles) sum += area(triangle);
  }
  return sum;
}

/// Whether one of the warnings contains all given words.
bool warns(const Scene& scene, const std::vector<std::string>& ids) {
  for (const std::string& warning : scene.warnings) {
    bool all = true;
    for (const std::string& id : ids) all = all && warning.find(id) != std::string::npos;
    if (all) return true;
  }
  return false;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("loadScene makes six surfaces of one family from a cube in one group", "[scene]") {
  const Scene scene = load(cubeVertices + "g box\n" + cubeFaces);
  CHECK(namesOf(scene) == Names{"box#1", "box#2", "box#3", "box#4", "box#5", "box#6"});
  for (const Surface& surface : scene.surfaces) CHECK(surface.family == "box");
  CHECK(totalArea(scene) == 6);
  CHECK(triangleCount(scene) == 12);
  CHECK(scene.origin == glm::dvec3(0.5));
  CHECK(scene.extent == Approx(std::sqrt(3.0)));
  CHECK(normal(scene.surfaces[0].triangles[0]) == glm::dvec3(0, 0, -1));
  for (std::uint32_t p = 0; p < 6; ++p) CHECK(scene.surfaces[p].triangles[1].polygon == p);
}

TEST_CASE("A few triangles far away do not count in the bounds, and are named", "[scene]") {
  const std::string box = cubeVertices + "g box\n" + cubeFaces;
  const auto withTriangleAt = [&](const std::string& x, const std::string& size) {
    return load(box + "v " + x + " 0 0\nv " + x + " " + size + " 0\nv " + x + " 0 " + size + "\ng far\nf -3 -2 -1\n");
  };
  for (const char* x : {"1000", "1e5", "3e6", "-1e8"}) {
    CAPTURE(x);
    const Scene scene = withTriangleAt(x, "1");
    CHECK(scene.origin == glm::dvec3(0.5));
    CHECK(scene.extent == Approx(std::sqrt(3.0)));
    CHECK(warns(scene, {"`far`", "away"}));
  }
  // Near enough, or large: a ground is part of the scene.
  for (const Scene& scene : {withTriangleAt("100", "1"), withTriangleAt("1e5", "10")}) {
    CHECK(scene.extent > 90);
    CHECK_FALSE(warns(scene, {"`far`"}));
  }
}

TEST_CASE("Coordinates that binary32 would round count as rounded by at most 2^-13 of the size of triangles",
          "[scene]") {
  std::string moved;
  for (int i = 0; i < 8; ++i)
    moved += "v " + std::to_string(10000000 + i % 2) + " " + std::to_string(10000000 + i / 2 % 2) + " " +
             std::to_string(10000000 + i / 4) + "\n";
  const Scene scene = load(moved + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  CHECK(coordinateRounding(scene) == 0.5);
  CHECK(meanSize(scene) == Approx(std::sqrt(0.5)));
  CHECK(scene.rounding == Approx(0x1p-13 * std::sqrt(0.5)));
}

TEST_CASE("loadScene names surfaces by group, and by material where a group has several, without duplicates",
          "[scene]") {
  struct Case {
    std::string structure;
    Names names;
  };
  // Faces a, b, c of the cube are far from each other's planes, so that each one is a surface.
  const std::string a = "f 1 4 3 2\n", b = "f 5 6 7 8\n", c = "f 1 2 6 5\n";
  const auto [structure, names] = GENERATE_COPY(values<Case>({
      {a, {"default"}},
      {a + "g wall\n" + b, {"default", "wall"}},
      {"g wall\nusemtl red\n" + a + "g floor\n" + b + "g wall\n" + c, {"wall#1", "wall#2", "floor"}},
      {"o wall\nusemtl red\n" + a + "usemtl blue\n" + b, {"wall/red", "wall/blue"}},
      {"o wall\n" + a + "usemtl blue\n" + b, {"wall/default", "wall/blue"}},
      {"o wall\nusemtl red\n" + a + b + "usemtl blue\n" + c, {"wall/red#1", "wall/red#2", "wall/blue"}},
      {"g w\nusemtl m\n" + a + "usemtl n\n" + b + "g w/m\n" + c, {"w/m", "w/n", "w/m~2"}},
      {"g w#1\n" + a + "g w\n" + b + c, {"w#1", "w#1~2", "w#2"}},
  }));
  const Scene scene = load(cubeVertices + structure);
  CHECK(namesOf(scene) == names);
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
}

TEST_CASE("loadScene makes one chart of a single quad by its corners, planar or not", "[scene]") {
  const std::string vertices = "v 0 0 0\nv 1 0 0.2\nv 1 1 0\nv 0 1 0.2\n";
  const auto faces = GENERATE(values<std::string>({
      "f 1 2 3 4\n",
      "vt 0 0\nvt 3 0\nvt 3 3\nvt 0 3\nf 1/1 2/2 3/3 4/4\n",  // a repeated texture is no chart
  }));
  const Scene scene = load(vertices + faces);
  REQUIRE(scene.surfaces.size() == 1);
  const std::vector<Triangle>& triangles = scene.surfaces[0].triangles;
  CHECK(triangles[0].chart == std::array{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1)});
  CHECK(triangles[1].chart == std::array{glm::dvec2(0, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)});
  CHECK(load(vertices + faces, {.charts = Charts::Planar}).surfaces.size() == 2);
}

TEST_CASE("loadScene uses the file's coordinates if they form a chart", "[scene]") {
  // Two triangles of a bent sheet: not planar, but the coordinates form a chart (a mirrored one) and are rounded to
  // multiples of 2^-24.
  const Scene scene = load(
      "v 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\nvt 0.9 0\nvt 0.1 0\nvt 0.1 1\nvt 0.9 1\n"
      "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  REQUIRE(scene.surfaces.size() == 1);
  const Triangle& triangle = scene.surfaces[0].triangles[0];
  const double left = 1677722 * 0x1p-24, right = 15099494 * 0x1p-24;  // 0.1 and 0.9 of 2^24 = 16777216
  CHECK(triangle.chart == std::array{glm::dvec2(right, 0), glm::dvec2(left, 0), glm::dvec2(left, 1)});
  CHECK(triangle.texcoord == std::array{glm::dvec2(0.9, 0), glm::dvec2(0.1, 0), glm::dvec2(0.1, 1)});
}

TEST_CASE("loadScene replaces coordinates that form no chart by planar parts, or refuses them with the reason",
          "[scene]") {
  struct Case {
    std::string coordinates, faces, reason;
  };
  const auto [coordinates, faces, reason] = GENERATE(values<Case>({
      {"vt 0 0\nvt 1 0\nvt 1 1\n", "f 1/1 2/2 3/3\nf 1 3 4\n", "the face (line 10) has none"},
      {"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1.5\n", "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n", "(line 11) leaves the unit square"},
      {"vt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.5\n", "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n", "(line 11) has no area"},
      {"vt 0 0\nvt 1 0\nvt 1 1\nvt 0.6 0\n", "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n", "(line 11) overlaps the face (line 10)"},
  }));
  const SceneFiles files("v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\ng sheet\n" + coordinates + faces);
  CHECK(namesOf(files.load()) == Names{"sheet#1", "sheet#2"});
  try {
    files.load({.charts = Charts::File});
    FAIL("accepted");
  } catch (const raster::InputError& error) {
    CHECK_THAT(error.what(), Catch::Contains("'sheet'"));
    CHECK_THAT(error.what(), Catch::Contains(reason));
  }
}

TEST_CASE("loadScene uses the chart for maps if the file has no coordinates", "[scene]") {
  for (const Surface& surface : load(cubeVertices + cubeFaces).surfaces) {
    for (const Triangle& triangle : surface.triangles) CHECK(triangle.texcoord == triangle.chart);
  }
}

TEST_CASE("loadScene drops and counts a face without area, but not a triangle without area inside a face", "[scene]") {
  const std::string obj =
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 0 0\nv 9 9 9\n"
      "v 0 0 1\nv 1 0 1\nv 2 0 1\nv 2 2 1\nv 0 0 2\nv 2 2 2\nv 0 2 2\n"
      "f 1 2 3 4\n"   // valid
      "f 1 5 2\n"     // collinear
      "f 6 6 6\n"     // a point, outside the bounds of the rest
      "f 7 8 9 10\n"  // its first fan triangle has no area
      "f 11 11 12 13\n";
  const Scene scene = load(obj);
  CHECK(totalArea(scene) == Approx(4 + 2 + 2));
  CHECK(triangleCount(scene) == 4);
  CHECK(warns(scene, {"2 faces without area dropped", "line 15"}));
  CHECK(scene.origin == glm::dvec3(1, 1, 1));
  for (const Surface& surface : scene.surfaces) {
    for (const Triangle& triangle : surface.triangles) CHECK(area(triangle) > 0);
  }
}

TEST_CASE("loadScene reports a face that crosses itself", "[scene]") {
  const Scene scene = load("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\n");
  CHECK(warns(scene, {"1 face that cross", "line 5"}));
}

TEST_CASE("loadScene refuses a scene without a face", "[scene]") {
  const auto obj = GENERATE(values<std::string>({"", "v 0 0 0\n", "v 0 0 0\nf 1 1 1\n", "v 0 0 0\nv 1 1 1\nl 1 2\n"}));
  CHECK_THROWS_WITH(load(obj), Catch::Contains("scene.obj") && Catch::Contains("empty"));
}

TEST_CASE("loadScene refuses a scene too small for binary32", "[scene]") {
  CHECK_THROWS_WITH(load("v 0 0 0\nv 1e-19 0 0\nv 0 1e-19 0\nf 1 2 3\n"), Catch::Contains("scale it up"));
  CHECK_NOTHROW(load("v 0 0 0\nv 1e-17 0 0\nv 0 1e-17 0\nf 1 2 3\n"));
}

TEST_CASE("loadScene keeps the area of concave faces", "[scene]") {
  const Scene scene = load("v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6\n");
  CHECK(scene.surfaces.size() == 1);
  CHECK(totalArea(scene) == Approx(5));
}

TEST_CASE("loadScene reads the materials that faces name, in the order of their first faces", "[scene]") {
  const SceneFiles files("mtllib scene.mtl more.mtl\n" + cubeVertices +
                             "usemtl red\nf 1 4 3 2\nusemtl lamp\nf 5 6 7 8\nusemtl red\nf 1 2 6 5\n",
                         "newmtl unused\nKd 1 1 1\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\nnewmtl lamp\nKe 9 9 9\n");
  files.write("more.mtl", "newmtl red\nKd 0.7 0.1 0.2\n");
  const Scene scene = files.load();
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].name == "red");
  CHECK(scene.materials[0].reflectance == glm::dvec3(0.7, 0.1, 0.2));
  CHECK(scene.materials[0].emission == glm::dvec3(0));
  CHECK(scene.materials[1].emission == glm::dvec3(3, 2, 1));
  CHECK(namesOf(scene) == Names{"default/red#1", "default/red#2", "default/lamp"});
  CHECK(scene.surfaces[2].material == 1);
  CHECK(scene.warnings.empty());
}

TEST_CASE("loadScene accepts blanks in the name of a material file", "[scene]") {
  const SceneFiles files("mtllib my scene.mtl\nusemtl red\n" + cubeVertices + cubeFaces);
  files.write("my scene.mtl", "newmtl red\nKd 0.7 0.1 0.2\n");
  CHECK(files.load().materials[0].reflectance == glm::dvec3(0.7, 0.1, 0.2));
}

TEST_CASE("loadScene replaces missing values by grey 0.5 with a warning", "[scene]") {
  SECTION("the material file") {
    const Scene scene = load("mtllib none.mtl\nusemtl red\n" + cubeVertices + cubeFaces);
    CHECK(warns(scene, {"none.mtl", "grey 0.5"}));
    CHECK(warns(scene, {"'red'", "grey 0.5"}));
    CHECK(scene.materials[0].reflectance == glm::dvec3(0.5));
  }
  SECTION("the material") {
    const Scene scene = load(cubeVertices + cubeFaces);
    CHECK(warns(scene, {"without a material", "grey 0.5"}));
    CHECK(scene.materials[0].reflectance == glm::dvec3(0.5));
  }
  SECTION("the materials of a format that has none, which is no fault") {
    const TemporaryFolder folder;
    hemitex::tests::writeAll(folder.path / "a.stl",
                             "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                             "endloop\nendfacet\nendsolid\n");
    const Scene scene = loadScene(folder.path / "a.stl");
    CHECK(scene.warnings.empty());
    CHECK(scene.materials[0].reflectance == glm::dvec3(0.5));
  }
  SECTION("its reflectance") {
    const Scene scene = loadMaterial("Ke 1 1 1\n");
    CHECK(warns(scene, {"'paint'", "no Kd", "grey 0.5"}));
    CHECK(scene.materials[0].reflectance == glm::dvec3(0.5));
  }
  SECTION("its map") {
    const Scene scene = loadMaterial("Kd 0.9 0.8 0.7\nmap_Kd none.png\nKe 4 4 4\nmap_Ke none.png\n");
    CHECK(warns(scene, {"none.png", "0.5"}));
    CHECK(scene.materials[0].reflectance == glm::dvec3(0.5));
    CHECK(scene.materials[0].emission == glm::dvec3(2));
    CHECK_FALSE(scene.materials[0].reflectanceMap);
    CHECK_FALSE(scene.materials[0].emissionMap);
    CHECK(scene.warnings.size() == 1);
  }
}

TEST_CASE("loadScene warns of materials that let light through, which it reads as opaque", "[scene]") {
  for (const char* way : {"d 0.5\n", "Tr 0.5\n"})
    CHECK_THAT(loadMaterial(std::string("Kd 0 0 0\n") + way).warnings.at(0), Catch::Contains("opaque"));
  CHECK(loadMaterial("Kd 0 0 0\nd 1\nTr 1\n").warnings.empty());
}

TEST_CASE("loadScene lowers a reflectance of 1 or more with a warning, and keeps smaller ones", "[scene]") {
  CHECK(loadMaterial("Kd 1 0.5 7\n").materials[0].reflectance == glm::dvec3(0.9999, 0.5, 0.9999));
  CHECK(loadMaterial("Kd 1 0.5 7\n").warnings.size() == 1);
  CHECK(loadMaterial("Kd 1 0.97 0\n", {.maxReflectance = 0.9}).materials[0].reflectance == glm::dvec3(0.9, 0.97, 0));
  CHECK(loadMaterial("Kd 0.99999 0 0\n").materials[0].reflectance == glm::dvec3(0.99999, 0, 0));
  CHECK(loadMaterial("Kd 0.99999 0 0\n").warnings.empty());
  CHECK_THROWS_AS(loadMaterial("Kd 1 1 1\n", {.maxReflectance = 1.0}), raster::InputError);
}

TEST_CASE("loadScene multiplies emission by pi if Ke is radiance, and its maps scale it as before", "[scene]") {
  constexpr double pi = std::numbers::pi;
  const SceneSettings radiance{.emission = EmissionUnit::Radiance};
  CHECK(loadMaterial("Kd 0.5\nKe 3 2 1\n").materials[0].emission == glm::dvec3(3, 2, 1));
  CHECK(loadMaterial("Kd 0.5\nKe 3 2 1\n", radiance).materials[0].emission == pi * glm::dvec3(3, 2, 1));
  CHECK(loadMaterial("Kd 0.5\nKe 3 2 1\n", radiance).materials[0].reflectance == glm::dvec3(0.5));
  CHECK(loadMaterial("Kd 0.5\nKe 4\nmap_Ke none.png\n", radiance).materials[0].emission == glm::dvec3(2 * pi));

  const SceneFiles files("mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
                         "newmtl a\nKd 0.5\nmap_Ke map.exr\n");
  writeExr(files.path("map.exr"), {1, 1, {glm::dvec3(0.25, 4, 1)}});
  const Scene scene = files.load(radiance);
  CHECK(scene.materials[0].emission == glm::dvec3(pi));  // the map alone
  CHECK(scene.images[static_cast<std::size_t>(*scene.materials[0].emissionMap)].pixels[0] == glm::dvec3(0.25, 4, 1));
  // The limits apply to radiosity.
  CHECK_THROWS_AS(loadMaterial("Kd 0.5\nKe 3.2e29\n", radiance), raster::InputError);
  CHECK_NOTHROW(requireEmission(loadMaterial("Kd 0.5\nKe 3.2e-31\n", radiance), "scene.obj"));
  CHECK_THROWS_AS(requireEmission(loadMaterial("Kd 0.5\nKe 3.1e-31\n", radiance), "scene.obj"), raster::InputError);
}

TEST_CASE("loadScene refuses a negative reflectance or emission with the line in the material file", "[scene]") {
  CHECK_THROWS_WITH(loadMaterial("Kd 0.5 -0.5 0.5\n"), Catch::Contains("scene.mtl:2"));
  CHECK_THROWS_WITH(loadMaterial("Kd 0.5\nKe 0 0 -1\n"), Catch::Contains("scene.mtl:3"));
}

TEST_CASE("loadScene reads maps once, relative to the material file", "[scene]") {
  const SceneFiles files("mtllib sub/scene.mtl\n" + cubeVertices + "usemtl a\nf 1 4 3 2\nusemtl b\nf 5 6 7 8\n");
  std::filesystem::create_directory(files.path("sub"));
  files.write("sub/scene.mtl", "newmtl a\nmap_Kd white.png\nmap_Ke white.png\nnewmtl b\nKd 0.5\nmap_Kd white.png\n");
  writePng(files.path("sub/white.png"), {1, 1, {glm::dvec3(1.0)}});
  const Scene scene = files.load();
  REQUIRE(scene.images.size() == 1);
  CHECK(scene.images[0].pixels == std::vector{glm::dvec3(1.0)});
  CHECK(scene.materials[0].reflectanceMap == 0);
  CHECK(scene.materials[0].reflectance == glm::dvec3(0.9999));  // the map alone
  CHECK(scene.materials[0].emission == glm::dvec3(1.0));        // the map alone
  CHECK(scene.materials[1].reflectance == glm::dvec3(0.5));
  CHECK(scene.warnings.empty());
}

TEST_CASE("loadScene lowers a map of reflectances to 1, and refuses a negative map", "[scene]") {
  const SceneFiles files("mtllib scene.mtl\nusemtl a\n" + cubeVertices + cubeFaces,
                         "newmtl a\nKd 0.5\nmap_Kd map.exr\nmap_Ke map.exr\n");
  writeExr(files.path("map.exr"), {1, 1, {glm::dvec3(0.25, 4, 1)}});
  const Scene scene = files.load();
  REQUIRE(scene.images.size() == 2);
  const Material& material = scene.materials[0];
  CHECK(scene.images[static_cast<std::size_t>(*material.reflectanceMap)].pixels[0] == glm::dvec3(0.25, 1, 1));
  CHECK(scene.images[static_cast<std::size_t>(*material.emissionMap)].pixels[0] == glm::dvec3(0.25, 4, 1));
  CHECK(warns(scene, {"map_Kd", "above 1"}));
  writeExr(files.path("map.exr"), {1, 1, {glm::dvec3(0.25, -4, 1)}});
  CHECK_THROWS_WITH(files.load(), Catch::Contains("map.exr") && Catch::Contains("negative"));
}

TEST_CASE("loadScene warns of a closed room that keeps nearly all light, by its surface", "[scene]") {
  const TemporaryFolder folder;
  const auto warningsFor = [&](const std::string& reflectance, bool isInverted) {
    hemitex::tests::writeAll(folder.path / "m.mtl", "newmtl a\nKd " + reflectance + "\nKe 1 1 1\n");
    std::string text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng walls\nusemtl a\n";
    for (const auto& [a, b, c] : {std::array{1, 2, 3}, std::array{1, 4, 2}, std::array{1, 3, 4}, std::array{2, 4, 3}})
      text += "f " + std::to_string(a) + " " + std::to_string(isInverted ? c : b) + " " +
              std::to_string(isInverted ? b : c) + "\n";
    hemitex::tests::writeAll(folder.path / "a.obj", text);
    std::string all;
    for (const std::string& warning : loadScene(folder.path / "a.obj").warnings) all += warning + "\n";
    return all;
  };
  const std::string words = "the closed room of `walls";
  CHECK_THAT(warningsFor("0.5 0.99 0.5", false), Catch::Contains(words) && Catch::Contains("reflects 0.99"));
  CHECK_THAT(warningsFor("0.94 0.94 0.94", false), !Catch::Contains(words));
  CHECK_THAT(warningsFor("0.99 0.99 0.99", true), !Catch::Contains(words));
}

TEST_CASE("loadScene warns where binary32 rounds coordinates by more than a hundredth of the size of faces",
          "[scene]") {
  const TemporaryFolder folder;
  const auto warningsAt = [&](double east, double size, double z = 0) {
    std::string bytes = std::string(80, ' ') + std::string("\x01\0\0\0", 4);
    const double corners[12] = {0, 0, 0, east, 5e6, z, east + size, 5e6, z, east, 5e6 + size, z};
    for (const double corner : corners) {
      const auto number = static_cast<float>(corner);
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    hemitex::tests::writeAll(folder.path / "a.stl", bytes + std::string(2, '\0'));
    std::string all;
    for (const std::string& warning : loadScene(folder.path / "a.stl").warnings) all += warning + "\n";
    return all;
  };
  CHECK_THAT(warningsAt(500000.1, 3.3), Catch::Contains("rounded to binary32"));
  CHECK_THAT(warningsAt(500000.1, 333), !Catch::Contains("rounded to binary32"));
  // No last bit is set, but coordinates finer than those of 5e6 say that these are rounded.
  CHECK_THAT(warningsAt(500000.125, 4), Catch::Contains("rounded to binary32"));
  // Whole metres with heights of any number are exact.
  CHECK_THAT(warningsAt(500000, 4, 17.3), !Catch::Contains("rounded to binary32"));
}

TEST_CASE("requireEmission throws InputError unless something emits", "[scene]") {
  CHECK_THROWS_WITH(requireEmission(loadMaterial("Kd 0.5\n"), "scene.obj"),
                    Catch::Contains("scene.obj") && Catch::Contains("emits") && Catch::Contains("Ke"));
  CHECK_NOTHROW(requireEmission(loadMaterial("Kd 0.5\nKe 0 0 1\n"), "scene.obj"));
  // A map that is 0 in the only emitting band removes all emission.
  Scene scene = loadMaterial("Kd 0.5\nKe 0 0 1\n");
  scene.images.push_back({1, 1, {glm::dvec3(1, 1, 0)}});
  scene.materials[0].emissionMap = 0;
  CHECK_THROWS_AS(requireEmission(scene, "scene.obj"), raster::InputError);
  // A material that no surface uses does not emit.
  scene.materials.push_back({.name = "unused", .emission = glm::dvec3(1)});
  CHECK_FALSE(emitsLight(scene));
  // Images cannot store values below 1e-45.
  CHECK_NOTHROW(requireEmission(loadMaterial("Kd 0.5\nKe 0 1e-30 1e-31\n"), "scene.obj"));
  CHECK_THROWS_WITH(requireEmission(loadMaterial("Kd 0.5\nKe 1e-31\n"), "scene.obj"),
                    Catch::Contains("scene.obj") && Catch::Contains("1e-30") && Catch::Contains("up"));
}

TEST_CASE("loadScene reports normals that the file lacks", "[scene]") {
  const Scene scene = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n");
  CHECK(warns(scene, {"normal 1", "line 4"}));
  CHECK(scene.surfaces.size() == 1);
}

TEST_CASE("loadScene with Sides::Two makes two surfaces of each, the second reversed", "[scene]") {
  const std::string box = cubeVertices + "g box\n" + cubeFaces;
  // The sides of a lid on the box would be those of the box.
  CHECK(load(box + "g lid\nf 8 7 6 5\n", {.sides = Sides::Two}).surfaces.size() == 12);
  const Scene scene = load(box + "v 0 0 3\nv 1 0 3\nv 1 1 3\nv 0 1 3\ng lid\nf 9 10 11 12\n", {.sides = Sides::Two});
  REQUIRE(scene.surfaces.size() == 14);
  CHECK(totalArea(scene) == 14);
  for (std::size_t s = 0; s < 7; ++s) {
    const Surface& front = scene.surfaces[s];
    const Surface& back = scene.surfaces[s + 7];
    CHECK(front.twin == static_cast<int>(s + 7));
    CHECK(back.twin == static_cast<int>(s));
    CHECK(back.name == front.name + "/back");
    CHECK(back.family == front.family + "/back");
    CHECK(scene.objects.at(static_cast<std::size_t>(back.object.value())).name ==
          scene.objects.at(static_cast<std::size_t>(front.object.value())).name + "/back");
    for (std::size_t t = 0; t < front.triangles.size(); ++t) {
      CHECK(normal(back.triangles[t]) == -normal(front.triangles[t]));
      CHECK(back.triangles[t].chart[1] == front.triangles[t].chart[2]);
    }
  }
  CHECK(scene.surfaces[6].name == "lid");
}

TEST_CASE("loadScene names the objects of an OBJ file, and keeps the surfaces of each together", "[scene]") {
  const Scene scene = load(cubeVertices + "o a\nusemtl m\nf 1 2 3 4\no b\nf 8 7 6 5\ng a\nusemtl n\nf 1 5 6 2\n");
  REQUIRE(scene.objects.size() == 2);
  CHECK((scene.objects[0].name == "a" && scene.objects[1].name == "b"));
  REQUIRE(scene.surfaces.size() == 3);
  const std::array<std::string, 3> names{"a/m", "a/n", "b"};
  for (std::size_t s = 0; s < 3; ++s) {
    CHECK(scene.surfaces[s].name == names[s]);
    CHECK(scene.surfaces[s].object == (s < 2 ? 0 : 1));
  }
}

TEST_CASE("Scene::files are the files that loadScene read", "[scene]") {
  const SceneFiles files("mtllib scene.mtl absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n",
                         "newmtl paint\nKd 1 1 1\nmap_Kd dot.pgm\nmap_Ke absent.png\n");
  files.write("dot.pgm", "P5 1 1 255\n@");
  CHECK(files.load().files == std::vector{files.path("scene.obj"), files.path("scene.mtl"), files.path("dot.pgm")});
}

TEST_CASE("loadScene says that coordinates are too large for the size of faces", "[scene]") {
  const SceneFiles files("v 1e15 1e15 1e15\nv 1000000000000000.5 1e15 1e15\nv 1e15 1000000000000000.5 1e15\nf 1 2 3\n");
  CHECK_THROWS_WITH(files.load(), Catch::Contains("scene.obj: no face has an area above rounding: the largest one is "
                                                  "0.5 units across, at coordinates up to 1e+15; move the scene"));
  CHECK_THROWS_WITH(load("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), Catch::Contains("the scene is empty"));
}

TEST_CASE("loadScene names a format that it does not read, by the name of the file or its first bytes", "[scene]") {
  const SceneFiles files("solid cube\nfacet normal 0 0 1\n");
  CHECK_THROWS_WITH(files.load(),
                    Catch::Contains("scene.obj: is an STL mesh, not OBJ or glTF; give it a name that ends in .stl"));
  for (const auto& [name, format] : {std::pair("a.BLEND", "a Blender file"),
                                     {"a.fbx", "an FBX scene"},
                                     {"a.3ds", "a 3DS scene"},
                                     {"a.step", "a STEP file"}}) {
    files.write(name, "\x01\x02");
    CHECK_THROWS_WITH(loadScene(files.path(name)), Catch::Contains(std::string(name) + ": is " + format));
  }
  CHECK_THROWS_WITH(loadScene(files.path("absent.stl")), Catch::Contains("cannot be read"));
}

TEST_CASE("findMaterials names at most 8 unknown materials, and at most 200 bytes of each", "[scene]") {
  std::string obj;
  for (int m = 0; m < 50; ++m) {
    const std::string number = std::to_string(m);
    for (const std::string corner : {"0 0 ", "1 0 ", "0 1 "}) obj += "v " + corner + number + "\n";
    obj += "usemtl " + std::string(1000, 'x') + number + "\nf -3 -2 -1\n";
  }
  const Scene scene = load(obj);
  CHECK(scene.warnings.back().size() < 2000);
  CHECK_THAT(scene.warnings.back(), Catch::EndsWith(" and 42 others"));
}

TEST_CASE("loadScene uses a repeated face once, with a warning", "[scene]") {
  const Scene scene = load(cubeVertices + "f 1 2 3 4\nf 3 4 1 2\nf 4 3 2 1\n");
  CHECK(totalArea(scene) == 2);  // the last face is the other side
  REQUIRE(scene.warnings.size() == 2);
  CHECK(scene.warnings[0] == "1 face left out, because another has the same corners (line 10)");
}

namespace {

/// Two squares that share the edge from (0, 0, 0) to (0, 1, 0) and meet at an angle in degrees. Each corner has the
/// normal of the given number: 1 faces up, 2 is that of the second square.
std::string bentSheet(double degrees, const std::string& normals) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  char text[512];
  std::snprintf(text, sizeof text,
                "v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv %.17g 0 %.17g\nv %.17g 1 %.17g\nvn 0 0 3\nvn %.17g 0 %.17g\n"
                "f 1//1 2//%c 3//%c 4//1\nf 2//%c 5//2 6//2 3//%c\n",
                c, -s, c, -s, s, c, normals[0], normals[0], normals[1], normals[1]);
  return text;
}

}  // namespace

TEST_CASE("loadScene joins faces that meet at less than the crease angle, or where the normals of the file agree",
          "[scene]") {
  const auto surfaces = [](const std::string& text, const SceneSettings& settings = {}) {
    return load(text, settings).surfaces.size();
  };
  const auto withoutNormals = [](double degrees) {
    return std::regex_replace(bentSheet(degrees, "11"), std::regex("//."), "");
  };
  CHECK(surfaces(withoutNormals(39)) == 1);
  CHECK(surfaces(withoutNormals(41)) == 2);
  CHECK(surfaces(withoutNormals(41), {.crease = 42}) == 1);
  CHECK(surfaces(withoutNormals(39), {.charts = Charts::Planar}) == 2);
  // The normals agree at the edge: "11" gives both squares the normal of the first one there.
  CHECK(surfaces(bentSheet(50, "11")) == 1);
  CHECK(surfaces(bentSheet(61, "11")) == 2);
  // They differ at the edge. One corner has not its face's normal, so that the normals count.
  CHECK(surfaces(bentSheet(30, "21")) == 2);
  CHECK(surfaces(bentSheet(30, "21"), {.crease = 40}) == 1);
  // All normals are those of the faces.
  CHECK(surfaces(bentSheet(30, "12")) == 1);
  // Normals without a finite length above 0 are as good as none.
  for (const char* broken : {"vn 0 0 0\n", "vn 1e300 0 0\n"})
    CHECK(surfaces(std::regex_replace(bentSheet(30, "21"), std::regex("vn 0 0 3\n"), broken)) == 1);
  const Scene joined = load(bentSheet(50, "11"));
  CHECK(joined.surfaces[0].curvedPart == 0U);
  CHECK_FALSE(load(cubeVertices + cubeFaces).surfaces[0].curvedPart);
}

// Four sides of a cube side by side: one chart without overlap. Each edge between two of them is a crease, which runs
// along borders of texels if a side is a quarter of the chart wide.
TEST_CASE("loadScene cuts the chart of the file at creases, except along texels or where charts are those of the file",
          "[scene]") {
  const auto cube = [](double side) {
    std::string text = cubeVertices;
    const std::array<std::array<int, 4>, 4> around{{{1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}}};
    for (int i = 0; i <= 4; ++i)
      text += "vt " + std::to_string(i * side) + " .25\nvt " + std::to_string(i * side) + " .5\n";
    for (int i = 0; i < 4; ++i) {
      const auto corner = [&](int k, int texcoord) {
        return " " + std::to_string(around[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]) + "/" +
               std::to_string(texcoord);
      };
      text += "f" + corner(0, 2 * i + 1) + corner(1, 2 * i + 3) + corner(2, 2 * i + 4) + corner(3, 2 * i + 2) + "\n";
    }
    return text;
  };
  CHECK(load(cube(0.25)).surfaces.size() == 1);
  const std::string text = cube(0.2);
  CHECK(load(text, {.charts = Charts::File}).surfaces.size() == 1);
  const Scene scene = load(text);
  REQUIRE(scene.surfaces.size() == 4);
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec2& p : triangle.chart) CHECK((p == glm::round(p)));
}
