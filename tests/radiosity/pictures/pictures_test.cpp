/// Pictures: orientation, filtering and Gouraud shading of the unlit view, and the views of item IDs and meshes.
#include "radiosity/pictures/pictures.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <set>

#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/pictures/id_pictures.h"
#include "radiosity/projection/projection_kinds.h"
#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// Sees the quad of fillingQuad from edge to edge.
const Camera ahead{{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 90};

Surface fillingQuad() { return parallelogram("quad", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}); }

/// A surface outside the view that moves the scene's origin away from the quad.
Surface farAway() { return parallelogram("far", {-1, -1, 3}, {1, 0, 0}, {0, 1, 0}); }

glm::dvec3 pixelAt(const Image& image, int column, int row) {
  return image.pixels[static_cast<std::size_t>(row * image.width + column)];
}

glm::ivec3 codesAt(const Image& image, int column, int row) {
  const glm::dvec3 pixel = pixelAt(image, column, row);
  return {encodeSrgb(pixel.x), encodeSrgb(pixel.y), encodeSrgb(pixel.z)};
}

const glm::dvec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), yellow(1, 1, 0);

Scene mappedScene(const Image& map) {
  Scene scene = sceneOf({fillingQuad(), farAway()}, {Material{.name = "map", .reflectance = glm::dvec3(1.0)}});
  scene.images = {map};
  scene.materials[0].reflectanceMap = 0;
  return scene;
}

/// A room with grids of 4 x 4 texels, its item IDs and its hemicube.
struct Room {
  Scene scene = makeRoom();
  Discretization discretization;
  IdLayout layout;

  Room() {
    for (int wall = 0; wall < 6; ++wall) addGrid(discretization, 4, 4);
    layout = layOut(discretization);
  }
};

std::uint64_t hashOf(const Image& image) {
  std::uint64_t hash = 14695981039346656037u;
  for (const glm::dvec3& pixel : image.pixels)
    for (int band = 0; band < 3; ++band) hash = (hash ^ encodeSrgb(pixel[band])) * 1099511628211u;
  return hash;
}

}  // namespace

TEST_CASE("drawPicture shows the background where it sees no surface, and averages it at edges", "[picture]") {
  // The quad covers the left half of the picture and half of a pixel more.
  const Scene scene = sceneOf({parallelogram("left", {-1, -1, 0}, {1.0 + 1.0 / 16, 0, 0}, {0, 2, 0}), farAway()});
  const glm::dvec3 sky(0.25, 0.5, 1);
  const Image picture = drawPicture(
      scene, ahead, 16, 16, [](const Visible&) { return glm::dvec3(1, 0, 0); }, sky);
  CHECK(pixelAt(picture, 7, 3) == red);
  CHECK(pixelAt(picture, 8, 3) == (red + sky) / 2.0);
  CHECK(pixelAt(picture, 9, 3) == sky);
}

// A slanted edge crosses 16 rows. With 16 samples in eight columns a pixel has a multiple of 1/16, within 1/8 of the
// share that the surface covers: samples of a column err by half of their distance, 1/16, on either side.
TEST_CASE("drawPicture takes sixteen samples of pixels that an edge crosses", "[picture]") {
  const auto [name, right] = GENERATE(
      table<std::string, Surface>({{"the background", farAway()},
                                   {"a fold", parallelogram("right", {-0.1, -1, 0}, {3, 0, -1}, {0.3, 2, 0})},
                                   {"an outline", parallelogram("right", {-6, -3, -1}, {12, 0, 0}, {0, 6, 0})},
                                   {"a plane", parallelogram("right", {-0.1, -1, 0}, {3, 0, 0}, {0.3, 2, 0})}}));
  INFO(name);
  Surface surface = parallelogram("left", {-3, -1, 0}, {2.9, 0, 0}, {0.3, 2, 0});
  surface.triangles.insert(surface.triangles.end(), right.triangles.begin(), right.triangles.end());
  const Scene scene = sceneOf({surface}, {Material{}});
  const Image image = drawPicture(scene, ahead, 16, 16,
                                  [](const Visible& visible) { return glm::dvec3(visible.triangle < 2 ? 1.0 : 0.0); });
  std::set<double> levels;
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 16; ++column) {
      const double found = pixelAt(image, column, row).x, y = 1 - (row + 0.5) / 8;
      const double edge = 8 * (1 + -0.1 + 0.15 * (y + 1));  // in pixels, in the middle of the row
      CHECK(std::abs(found - std::clamp(edge - column, 0.0, 1.0)) <= (name == "a plane" ? 0.5 : 0.125));
      CHECK(16 * found == std::round(16 * found));
      levels.insert(found);
    }
  CHECK((levels.size() >= 6) == (name != "a plane"));  // 2 x 2 samples have at most five
}

TEST_CASE("skyColour is the sky's irradiance times the exposure, at most 1", "[picture]") {
  CHECK(skyColour({0.5, 1, 4}, 0.5) == glm::dvec3(0.25, 0.5, 1));
  CHECK(skyColour(glm::dvec3(0), 100) == glm::dvec3(0));
}

TEST_CASE("unlitPicture shows a texture upright and not mirrored", "[picture]") {
  // Row 0 of an image is its top, v = 0 its bottom: red is in the upper left, where u = 0 and v = 1. The middle of
  // pixel 16 of 66 is that of the first texel, and its samples lie 1/264 of the map beside it.
  const Image picture = unlitPicture(mappedScene({2, 2, {red, green, blue, yellow}}), ahead, 66, 66);
  CHECK(glm::distance(pixelAt(picture, 16, 16), red) < 0.03);
  CHECK(glm::distance(pixelAt(picture, 49, 16), green) < 0.03);
  CHECK(glm::distance(pixelAt(picture, 16, 49), blue) < 0.03);
  CHECK(glm::distance(pixelAt(picture, 49, 49), yellow) < 0.03);
}

TEST_CASE("unlitColour is bilinear between the centres of a map's pixels, and repeats the map", "[picture]") {
  const Scene scene = mappedScene({2, 1, {glm::dvec3(0.0), glm::dvec3(1.0)}});
  const auto at = [&](double u) {  // along the quad's lower edge, where u is the second weight
    return unlitColour(scene, {.surface = 0, .triangle = 0, .weights = {1 - u, u, 0}}).x;
  };
  CHECK(at(0.25) == Approx(0).margin(1e-15));
  CHECK(at(0.5) == Approx(0.5));
  CHECK(at(0.625) == Approx(0.75));
  CHECK(at(0.75) == Approx(1));
  CHECK(at(0) == Approx(0.5));
  CHECK(at(1) == Approx(0.5));
  CHECK(at(0.125) == Approx(0.25));
}

TEST_CASE("unlitColour repeats the map for coordinates far outside", "[picture]") {
  Scene scene = mappedScene({2, 1, {glm::dvec3(0.0), glm::dvec3(1.0)}});
  for (glm::dvec2& texcoord : scene.surfaces[0].triangles[0].texcoord) texcoord += glm::dvec2(-7, 1 << 20);
  CHECK(unlitColour(scene, {.surface = 0, .triangle = 0, .weights = {0.5, 0.5, 0}}).x == Approx(0.5));
  for (glm::dvec2& texcoord : scene.surfaces[0].triangles[0].texcoord) texcoord = glm::dvec2(-1e300, 1e300);
  CHECK(std::isfinite(unlitColour(scene, {.surface = 0, .triangle = 0, .weights = {0.5, 0.5, 0}}).x));
}

TEST_CASE("unlitPicture shows Kd without a map, and black for the background", "[picture]") {
  Scene scene = sceneOf({parallelogram("half", {-1, -1, 0}, {1, 0, 0}, {0, 2, 0}), farAway()});
  scene.materials[0].reflectance = {0.25, 0.5, 0.75};
  const Image picture = unlitPicture(scene, ahead, 8, 8);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column)
      CHECK(pixelAt(picture, column, row) == (column < 4 ? glm::dvec3(0.25, 0.5, 0.75) : glm::dvec3(0.0)));
}

TEST_CASE("elementPicture shows one value per element, v upwards", "[picture]") {
  const Scene scene = sceneOf({fillingQuad(), farAway()});
  Discretization discretization;
  addGrid(discretization, 2, 2);
  addGrid(discretization, 1, 1);
  const std::vector<glm::dvec3> values{blue, yellow, red, green, glm::dvec3(9.0)};
  const Image picture = elementPicture(scene, discretization, valuesIn(values), ahead, 8, 8);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column)
      CHECK(pixelAt(picture, column, row) == (row < 4 ? (column < 4 ? red : green) : (column < 4 ? blue : yellow)));
}

TEST_CASE("drawPicture throws InputError for a picture that is too large", "[picture]") {
  const Scene scene = makeRoom();
  CHECK_THROWS_AS(unlitPicture(scene, ahead, 2049, 1), raster::InputError);
}

TEST_CASE("indexMapImage gives adjacent texels different levels", "[picture]") {
  for (int columns = 1; columns <= 20; ++columns)
    for (int rows = 1; rows <= 20; ++rows) {
      const Image map = indexMapImage(columns, rows, 1);
      for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
          const int level = codesAt(map, column, row).x;
          REQUIRE(level <= 127);
          if (column > 0) REQUIRE(std::abs(level - codesAt(map, column - 1, row).x) >= 31);
          if (row > 0) REQUIRE(std::abs(level - codesAt(map, column, row - 1).x) >= 31);
        }
    }
}

TEST_CASE("indexMapPicture of a quad is the index map, v upwards", "[picture]") {
  const Scene scene = sceneOf({fillingQuad(), farAway()});
  Discretization discretization;
  addGrid(discretization, 4, 2);
  addGrid(discretization, 1, 1);
  const IdLayout layout = layOut(discretization, {"r8g8b8", raster::Blend::ClampedAdd, true});
  const Image seen = indexMapPicture(scene, discretization, layout, ahead, 16, 16);
  const Image map = indexMapImage(4, 2, 1);
  CHECK(codesAt(map, 0, 1) == glm::ivec3(15));  // texel 0 is in the lower left, and the darkest
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 16; ++column)
      REQUIRE(pixelAt(seen, column, row) == pixelAt(map, column / 4, row / 8));
}

TEST_CASE("idPicture is the sum of indexMapPicture and offsetPicture, in codes", "[picture]") {
  const Room room;
  const Camera camera{{0.3, -0.2, 0.4}, {-0.7, 0.1, -0.9}, {0.1, 1, 0.2}, 90};
  const auto draw = [&](auto picture) { return picture(room.scene, room.discretization, room.layout, camera, 60, 50); };
  const Image maps = draw(indexMapPicture), offsets = draw(offsetPicture), ids = draw(idPicture);
  std::set<int> levels;
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 60; ++column) {
      REQUIRE(codesAt(ids, column, row) == codesAt(maps, column, row) + codesAt(offsets, column, row));
      levels.insert(codesAt(maps, column, row).x);
    }
  CHECK(levels.size() == 16);
}

TEST_CASE("blendErrorPicture shows and counts the errors of a clamped add with unaligned offsets", "[picture]") {
  // The far grid's 250 item IDs come first, so that the quad's are 250 to 265, and a channel of 8 bits ends at 255. So
  // texels 6 to 15 become 255, the item ID of texel 5.
  const Scene scene = sceneOf({farAway(), fillingQuad()});
  Discretization discretization;
  addGrid(discretization, 25, 10);
  addGrid(discretization, 4, 4);
  const glm::ivec3 magenta(255, 0, 255);
  const auto errorsOf = [&](const IdSettings& ids) {
    return blendErrorPicture(scene, discretization, layOut(discretization, ids), ahead, 16, 16);
  };
  const BlendErrors errors = errorsOf({"r8g8b8", raster::Blend::ClampedAdd, false});
  CHECK(errors.pixels == 10 * 16);
  const Image right = errorsOf({"r8g8b8", raster::Blend::IntegerAdd, false}).picture;
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 16; ++column) {
      const bool isWrong = (15 - row) / 4 * 4 + column / 4 > 5;
      REQUIRE(codesAt(errors.picture, column, row) == (isWrong ? magenta : codesAt(right, column, row)));
      REQUIRE(codesAt(right, column, row).x == codesAt(right, column, row).y);
    }
  CHECK(errorsOf({"r8g8b8", raster::Blend::ClampedAdd, true}).pixels == 0);
  CHECK(errorsOf({"r8g8b8", raster::Blend::IntegerAdd, false}).pixels == 0);
  // 16 bits in channels of 5, 6 and 5: the sum overflows the first channel.
  CHECK(errorsOf({"r5g6b5", raster::Blend::ClampedAdd, false}).pixels > 0);
  CHECK(errorsOf({.format = "r8g8b8", .indexMaps = IndexMaps::Unique}).pixels == 0);
}

TEST_CASE("offsetPicture gives packed surfaces the hue of their page, and indexMapPicture gives unique maps levels",
          "[picture]") {
  const Room room;
  const Camera camera{{0.3, -0.2, 0.4}, {-0.7, 0.1, -0.9}, {0.1, 1, 0.2}, 90};
  const auto coloursOf = [&](const IdSettings& ids, auto picture) {
    const Image image = picture(room.scene, room.discretization, layOut(room.discretization, ids), camera, 60, 50);
    std::set<std::array<int, 3>> colours;
    for (int row = 0; row < 50; ++row)
      for (int column = 0; column < 60; ++column) {
        const glm::ivec3 codes = codesAt(image, column, row);
        colours.insert({codes.x, codes.y, codes.z});
      }
    return colours;
  };
  // The camera sees four walls: two pages of 8 x 8 hold six of 4 x 4, four and two.
  CHECK(coloursOf({}, offsetPicture).size() > 2);
  CHECK(coloursOf({.indexMaps = IndexMaps::Packed, .page = 8}, offsetPicture).size() == 2);
  CHECK(coloursOf({.indexMaps = IndexMaps::Packed, .page = 16}, offsetPicture).size() == 1);
  CHECK(coloursOf({.indexMaps = IndexMaps::Unique}, indexMapPicture).size() == 16);
}

TEST_CASE("wireframePicture shows polygons, not their triangles", "[picture]") {
  const Scene whole = sceneOf({fillingQuad(), farAway()});
  for (const glm::dvec3& pixel : wireframePicture(whole, ahead, 16, 16).pixels) REQUIRE(pixel == glm::dvec3(1.0));

  Surface cut = fillingQuad();
  cut.triangles[1].polygon = 1;
  const Image diagonal = wireframePicture(sceneOf({cut, farAway()}), ahead, 16, 16);
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 16; ++column) {
      const int fromDiagonal = std::abs(15 - row - column);
      if (fromDiagonal == 0) CHECK(pixelAt(diagonal, column, row).x < 0.5);
      if (fromDiagonal > 1) CHECK(pixelAt(diagonal, column, row).x == 1);
    }
}

TEST_CASE("meshPicture shows the borders of elements, one pixel wide", "[picture]") {
  const Scene scene = sceneOf({fillingQuad(), farAway()});
  Discretization discretization;
  addGrid(discretization, 4, 2);
  addGrid(discretization, 1, 1);
  const Image mesh = meshPicture(scene, discretization, ahead, 32, 32);
  for (int row = 0; row < 32; ++row)
    for (int column = 0; column < 32; ++column) {
      // A border between two pixels blackens the nearer half of each.
      const auto touches = [](int pixel, int side) { return pixel % side == side - 1 || pixel % side == 0; };
      const bool vertical = touches(column, 8) && column != 0 && column != 31;
      const bool horizontal = row == 15 || row == 16;
      REQUIRE(pixelAt(mesh, column, row).x == (vertical && horizontal ? 0.25 : vertical || horizontal ? 0.5 : 1));
    }
}

TEST_CASE("hemicubePicture shows the ceiling in the middle and the walls around it", "[picture]") {
  const Room room;
  raster::SoftwareRenderer renderer(makeDrawList(room.scene, room.discretization, room.layout));
  // Over the floor's middle, rows towards the back wall.
  const auto faces = facesOver(hemicubeFaces(32), {0, -0.999, 0}, {0, 1, 0}, {0, 0, -1}, 1e-4);
  const std::vector<raster::ItemBuffer> buffers = render(renderer, faces, {});
  const Image picture = hemicubePicture(room.layout, faces, buffers);
  REQUIRE(picture.width == 64);
  // The view from the floor's middle upwards, with the back wall at the top. Left and right are exchanged, as on a map
  // of the sky.
  const auto hueAt = [&](int column, int row) {
    const glm::ivec3 codes = codesAt(picture, column, row);
    return codes - std::min({codes.x, codes.y, codes.z});
  };
  const auto hueOf = [&](const char* name) {
    const auto& surfaces = room.scene.surfaces;
    const auto surface = std::find_if(surfaces.begin(), surfaces.end(), [&](const auto& s) { return s.name == name; });
    const glm::dvec3 middle = 0.5 * (surface->triangles[0].position[0] + surface->triangles[0].position[2]);
    const Camera camera{{0, 0, 0}, middle, {0.1, 0.2, 0.3}, 20};
    const glm::ivec3 codes = codesAt(offsetPicture(room.scene, room.discretization, room.layout, camera, 1, 1), 0, 0);
    return codes - std::min({codes.x, codes.y, codes.z});
  };
  CHECK(hueAt(32, 32) == hueOf("ceiling"));
  CHECK(hueAt(32, 2) == hueOf("back"));
  CHECK(hueAt(32, 61) == hueOf("front"));
  CHECK(hueAt(2, 32) == hueOf("right"));
  CHECK(hueAt(61, 32) == hueOf("left"));
  CHECK(codesAt(picture, 5, 5) == glm::ivec3(160));
}

TEST_CASE("unlitPicture gives the same pixels on all machines", "[picture]") {
  const Room room;
  const Camera camera{glm::dvec3(-2.0 / 3), {0, 0, 0}, {0, 1, 0}, 60};
  CHECK(hashOf(idPicture(room.scene, room.discretization, room.layout, camera, 80, 60)) == 0x43534eded0eafb4cu);
  CHECK(hashOf(wireframePicture(room.scene, camera, 80, 60)) == 0x1608f71a4e0d695u);
}
