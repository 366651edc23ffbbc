/// writeLitScene: the files are read again, and show the light of the solution.
#include "radiosity/textures/lit_scene.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "radiosity/images/image.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/corner_radiosity.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/input_error.h"
#include "tests/support/picture_scenes.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The value of a linear colour in an 8-bit file.
double quantized(double linear) { return decodeSrgb(encodeSrgb(linear) / 255.0); }

/// The reflectance in a picture of a scene that was read again: Kd is 1, which loadScene lowers to this.
const double kd = SceneSettings{}.maxReflectance;

const PictureView view{{{0.3, -0.2, 0.4}, {-0.7, 0.1, -0.9}, {0.1, 1, 0.2}, 90}, 1.2};

void writeSolution(const std::filesystem::path& folder, const Scene& scene, const Discretization& discretization,
                   const Solution& solution, double exposure, TextureFilter filter = TextureFilter::Bicubic,
                   const Magnification& magnification = {}) {
  const std::vector<glm::dvec3> displayed = displayRadiosity(scene, discretization, solution);
  const TextureLayout layout = layOutTextures(scene, discretization, magnification);
  const std::vector<std::string> warnings =
      writeLitScene(folder, makeLitScene(scene, discretization, layout, displayed, exposure, filter), view,
                    radiosityTextures(discretization, layout, solution.radiosity));
  CHECK(warnings.empty());
}

/// The room with walls of tiles x tiles quads each; grids of 5 x 3 texels, or none for every third tile.
struct TiledRoom {
  Scene scene;
  Discretization discretization;

  explicit TiledRoom(int tiles) {
    std::vector<Surface> surfaces;
    for (const Surface& wall : makeRoom().surfaces) {
      const glm::dvec3 corner = wall.triangles[0].position[0];
      const glm::dvec3 u = (wall.triangles[0].position[1] - corner) / static_cast<double>(tiles);
      const glm::dvec3 v = (wall.triangles[1].position[2] - corner) / static_cast<double>(tiles);
      for (int i = 0; i < tiles * tiles; ++i)
        surfaces.push_back(parallelogram(wall.name + " " + std::to_string(i),
                                         corner + double(i % tiles) * u + double(i / tiles) * v, u, v));
    }
    for (std::size_t s = 0; s < surfaces.size(); ++s) addGrid(discretization, s % 3 ? 5 : 1, s % 3 ? 3 : 1);
    scene = sceneOf(std::move(surfaces));
  }
};

Solution solutionOf(const std::vector<glm::dvec3>& radiosity) {
  Solution solution;
  solution.radiosity = radiosity;
  return solution;
}

}  // namespace

TEST_CASE("writeLitScene keeps positions, winding and order, and puts texture coordinates inside the charts",
          "[lit-scene]") {
  for (int tiles : {2, 4}) {  // 24 surfaces with textures of their own, 96 that share them
    const TemporaryFolder folder;
    TiledRoom room(tiles);
    room.scene.surfaces[0].triangles[0].position[1] += glm::dvec3(1e-17, 1.0 / 3, 1e-9);
    writeSolution(folder.path, room.scene, room.discretization,
                  solutionOf(std::vector<glm::dvec3>(room.discretization.elements.size(), glm::dvec3(1.0))), 1);
    const Scene lit = loadScene(folder.path / "scene.obj");
    REQUIRE(lit.surfaces.size() == room.scene.surfaces.size());
    const TextureLayout layout = layOutTextures(room.scene, room.discretization, {});
    for (std::uint32_t s = 0; s < lit.surfaces.size(); ++s)
      for (std::size_t t = 0; t < 2; ++t) {
        const Triangle& written = room.scene.surfaces[s].triangles[t];
        REQUIRE(lit.surfaces[s].triangles[t].position == written.position);
        for (std::size_t k = 0; k < 3; ++k)
          REQUIRE(lit.surfaces[s].triangles[t].texcoord[k] ==
                  textureCoordinate(room.discretization, layout, s, written.chart[k]));
      }
  }
}

TEST_CASE("loadScene reads from the files of writeLitScene the scene of makeLitScene", "[lit-scene]") {
  for (const int tiles : {2, 4}) {
    const TemporaryFolder folder;
    const TiledRoom room(tiles);
    std::vector<glm::dvec3> displayed;
    for (std::size_t e = 0; e < room.discretization.elements.size(); ++e)
      displayed.emplace_back(0.01 * static_cast<double>(e % 90), 0.5, 1.0 / (1 + static_cast<double>(e % 7)));
    const TextureLayout layout = layOutTextures(room.scene, room.discretization, {});
    const LitScene lit = makeLitScene(room.scene, room.discretization, layout, displayed, 0.9, TextureFilter::Bicubic);
    writeLitScene(folder.path, lit, view, radiosityTextures(room.discretization, layout, displayed));
    const Scene read = loadScene(folder.path / "scene.obj");
    CHECK(read.origin == lit.scene.origin);
    CHECK(read.extent == lit.scene.extent);
    const Image expected = unlitPicture(read, view.camera, 60, 50), found = unlitPicture(lit, view.camera, 60, 50);
    CHECK(found.pixels == expected.pixels);
  }
}

TEST_CASE("writeLitScene shows constant light as one colour, without a visible edge or a dark border", "[lit-scene]") {
  const glm::dvec3 light(0.02, 3, 7);
  for (int tiles : {2, 4}) {
    const TemporaryFolder folder;
    const TiledRoom room(tiles);
    writeSolution(folder.path, room.scene, room.discretization,
                  solutionOf(std::vector<glm::dvec3>(room.discretization.elements.size(), light)), 0.125);
    const Image picture = unlitPicture(loadScene(folder.path / "scene.obj"), view.camera, 60, 50);
    const glm::dvec3 expected = kd * glm::dvec3(quantized(0.0025), quantized(0.375), quantized(0.875));
    for (const glm::dvec3& pixel : picture.pixels) REQUIRE(glm::distance(pixel, expected) < 1e-14);
  }
}

TEST_CASE("writeLitScene writes the radiosity of the elements to the EXR, as floats, and nothing else", "[lit-scene]") {
  const TemporaryFolder folder;
  TiledRoom room(1);
  std::vector<glm::dvec3> radiosity;
  for (std::size_t e = 0; e < room.discretization.elements.size(); ++e)
    radiosity.emplace_back(0.1 * static_cast<double>(e), std::sqrt(static_cast<double>(e)),
                           1e5 / (1.0 + static_cast<double>(e)));
  Solution solution = solutionOf(radiosity);
  solution.ambient = glm::dvec3(3.0);
  writeSolution(folder.path, room.scene, room.discretization, solution, 0.01);
  const TextureLayout layout = layOutTextures(room.scene, room.discretization, {});
  CHECK(layout.names[0] == "left_0");
  for (std::size_t s = 0; s < 6; ++s) {
    const Grid& grid = room.discretization.grids[s];
    const Image texture = readImage(folder.path / (layout.names[s] + ".exr"));
    REQUIRE(texture.width == grid.columns + 2);
    REQUIRE(texture.height == grid.rows + 2);
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const auto element = grid.firstElement + static_cast<std::uint32_t>(row * grid.columns + column);
        const auto pixel = static_cast<std::size_t>((grid.rows - row) * texture.width + column + 1);
        REQUIRE(texture.pixels[pixel] == glm::dvec3(glm::vec3(radiosity[element])));
      }
  }
}

TEST_CASE("writeLitScene writes filtered radiosity with the ambient estimate, exposed, to the PNG", "[lit-scene]") {
  const TemporaryFolder folder;
  Discretization discretization;
  addGrid(discretization, 3, 1);
  Scene scene = sceneOf({parallelogram("wall", {0, 0, 0}, {3, 0, 0}, {0, 1, 0})});
  scene.materials[0].reflectance = {0.5, 0.25, 0};
  Solution solution = solutionOf({glm::dvec3(0.0), glm::dvec3(1.0), glm::dvec3(0.0)});
  solution.ambient = glm::dvec3(0.4);
  writeSolution(folder.path, scene, discretization, solution, 0.5, TextureFilter::Triangle, {1});
  const Image texture = readImage(folder.path / "wall.png");
  REQUIRE(texture.width == 5);
  // (1 2 1) over 0 1 0 gives 1/3, 1/2, 1/3 at the three texels; the ambient estimate adds 0.2, 0.1, 0.
  const std::vector<double> filtered{1.0 / 3, 1.0 / 3, 0.5, 1.0 / 3, 1.0 / 3};
  for (std::size_t pixel = 0; pixel < texture.pixels.size(); ++pixel) {
    const double b = filtered[pixel % 5];
    CHECK(texture.pixels[pixel] ==
          glm::dvec3(quantized(0.5 * (b + 0.2)), quantized(0.5 * (b + 0.1)), quantized(0.5 * b)));
  }
}

TEST_CASE("writeLitScene makes surfaces of one texel Gouraud shaded if their corners differ", "[lit-scene]") {
  const TemporaryFolder folder;
  const Scene scene =
      sceneOf({parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), parallelogram("b", {1, 0, 0}, {1, 0, 0}, {0, 1, 0}),
               parallelogram("alone", {0, 5, 0}, {1, 0, 0}, {0, 1, 0})});
  Discretization discretization;
  for (int s = 0; s < 3; ++s) addGrid(discretization, 1, 1);
  writeSolution(folder.path, scene, discretization, solutionOf({glm::dvec3(0.2), glm::dvec3(0.5), glm::dvec3(0.7)}), 1);
  const Scene lit = loadScene(folder.path / "scene.obj");
  const auto colourAt = [&](std::uint32_t surface, const glm::dvec3& weights) {
    return unlitColour(lit, {.surface = surface, .triangle = 0, .weights = weights});
  };
  const auto isClose = [](const glm::dvec3& colour, double expected, double tolerance) {
    return glm::distance(colour, glm::dvec3(kd * expected)) < tolerance;
  };
  CHECK(isClose(colourAt(2, {0.2, 0.3, 0.5}), quantized(0.7), 1e-14));
  // The corners at x = 0 belong only to a. At (1,0) one triangle of a meets two of b, at (1,1) two and one. The second
  // triangle bends the colours at the diagonal, and codes of 8 bits are some thousandths apart.
  const glm::dvec3 corners(0.2, (0.2 + 2 * 0.5) / 3, (2 * 0.2 + 0.5) / 3);
  for (const glm::dvec3& weights : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1),
                                    glm::dvec3(0.25, 0.5, 0.25), glm::dvec3(0.4, 0.2, 0.4)})
    CHECK(isClose(colourAt(0, weights), glm::dot(weights, corners), 0.02));
  CHECK(isClose(colourAt(0, {0.25, 0.5, 0.25}), 0.325, 0.006));
}

TEST_CASE("drawCorners gives a triangle the exact colours for bilinear interpolation, up to its corners",
          "[lit-scene]") {
  const Surface surface =
      surfaceOf("t", {triangleOf({{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0.25}}, {{0, 1, 0}, {0.5, 1}})});
  Grid grid;
  grid.columns = grid.rows = 1;
  const CornerColours corners{glm::dvec3(0.2, 0, 5), glm::dvec3(0.7, 1, 5), glm::dvec3(0.4, 3, 5)};
  for (const int magnification : {1, 2, 4}) {
    const int side = 4 * magnification;  // one more column than the place, to the left
    Image texture{side, 3 * magnification,
                  std::vector<glm::dvec3>(static_cast<std::size_t>(3 * side * magnification), glm::dvec3(-9))};
    drawCorners(surface, {corners}, {0, 2, 1}, grid, magnification, texture);
    for (const glm::dvec3& weights : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1),
                                      glm::dvec3(0.5, 0.5, 0), glm::dvec3(0.2, 0.3, 0.5)}) {
      const Triangle& triangle = surface.triangles[0];
      const glm::dvec2 chart =
          weights.x * triangle.chart[0] + weights.y * triangle.chart[1] + weights.z * triangle.chart[2];
      const glm::dvec3 expected = weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
      CHECK(glm::distance(bilinear(texture, {(2 + chart.x) / 4, (1 + chart.y) / 3}), expected) < 1e-12);
    }
    CHECK(texture.pixels.front() == glm::dvec3(-9));
  }
}

TEST_CASE("writeLitScene magnifies display textures, and keeps one texel per element in the EXR", "[lit-scene]") {
  const TemporaryFolder folder;
  const TiledRoom room(1);  // grids of 5 x 3 texels
  const std::vector<glm::dvec3> radiosity(room.discretization.elements.size(), glm::dvec3(1));
  writeSolution(folder.path, room.scene, room.discretization, solutionOf(radiosity), 0.5);
  const Image display = readImage(folder.path / "right_0.png"), linear = readImage(folder.path / "right_0.exr");
  CHECK((linear.width == 7 && linear.height == 5));
  CHECK((display.width == 7 * 32 && display.height == 5 * 32));  // 5 * 32 = 160 texels, and 5 * 16 = 80
}

TEST_CASE("writeLitScene makes each object of the scene an object and a group, with the materials of the scene",
          "[lit-scene]") {
  const TemporaryFolder folder;
  TiledRoom room(4);  // 16 tiles per wall, which share textures of two magnifications
  room.scene.materials = {Material{.name = "white"}, Material{.name = "my red"}};
  room.scene.objects = {{"house"}};
  for (const char* name : {"left", "right wall", "floor", "ceiling", "near", "far"})
    room.scene.objects.push_back({name, 0});
  for (std::size_t s = 0; s < 96; ++s) {
    room.scene.surfaces[s].object = static_cast<int>(s / 16) + 1;
    room.scene.surfaces[s].material = s / 16 == 1 ? 1 : 0;
  }
  const std::vector<glm::dvec3> radiosity(room.discretization.elements.size(), glm::dvec3(1));
  writeSolution(folder.path, room.scene, room.discretization, solutionOf(radiosity), 0.5);
  std::vector<std::string> objects, groups;
  std::set<std::string> materials;
  for (const std::string& line : linesOf(textOf(folder.path / "scene.obj"))) {
    if (line.starts_with("o ")) objects.push_back(line.substr(2));
    if (line.starts_with("g ")) groups.push_back(line.substr(2));
    if (line.starts_with("usemtl ")) materials.insert(line.substr(7));
  }
  CHECK(objects == std::vector<std::string>{"left", "right_wall", "floor", "ceiling", "near", "far"});
  CHECK(groups == objects);
  const TextureLayout layout = layOutTextures(room.scene, room.discretization, {});
  std::set<std::string> expected;
  for (std::size_t s = 0; s < 96; ++s)
    expected.insert((s / 16 == 1 ? "my_red/" : "white/") +
                    layout.names[static_cast<std::size_t>(layout.places[s].texture)]);
  CHECK(expected.size() <= 2 * layout.names.size());
  CHECK(materials == expected);
}

TEST_CASE("writeLitScene replaces names that files and groups cannot have", "[lit-scene]") {
  const TemporaryFolder folder;
  Discretization discretization;
  std::vector<Surface> surfaces;
  for (const char* name : {"a/b", "A b", "a_b#1", "render", "gouraud"}) {
    surfaces.push_back(parallelogram(name, {2.0 * static_cast<double>(surfaces.size()), 0, 0}, {1, 0, 0}, {0, 1, 0}));
    addGrid(discretization, 2, 2);
  }
  const Scene scene = sceneOf(surfaces);
  writeSolution(folder.path, scene, discretization, solutionOf(std::vector<glm::dvec3>(20, glm::dvec3(0.5))), 1);
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path)) files.insert(entry.path().filename());
  CHECK(files == std::set<std::string>{"a_b.png", "a_b.exr", "A_b-2.png", "A_b-2.exr", "a_b_1.png", "a_b_1.exr",
                                       "render-2.png", "render-2.exr", "gouraud.png", "gouraud.exr", "scene.obj",
                                       "scene.mtl", "scene.glb"});
  const Scene lit = loadScene(folder.path / "scene.obj");
  CHECK(lit.surfaces.size() == 5);
  for (const Material& material : lit.materials) CHECK(material.reflectanceMap);
}

TEST_CASE("writeLitScene writes the same bytes again", "[lit-scene]") {
  const TemporaryFolder folder;
  const TiledRoom room(2);
  const std::vector<glm::dvec3> radiosity(room.discretization.elements.size(), glm::dvec3(1.0 / 3));
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directory(folder.path / name);
    writeSolution(folder.path / name, room.scene, room.discretization, solutionOf(radiosity), 0.7);
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "a"))
    REQUIRE(textOf(entry.path()) == textOf(folder.path / "b" / entry.path().filename()));
}

TEST_CASE("writeLitScene throws InputError for a missing folder", "[lit-scene]") {
  const TemporaryFolder folder;
  const TiledRoom room(1);
  const std::vector<glm::dvec3> radiosity(room.discretization.elements.size());
  CHECK_THROWS_AS(writeSolution(folder.path / "absent", room.scene, room.discretization, solutionOf(radiosity), 1),
                  raster::InputError);
}
