/// Radiosity textures: places of charts, the filter, the border and Gouraud corners.
#include "radiosity/textures/radiosity_texture.h"

#include <array>
#include <catch2/catch.hpp>
#include <random>

#include "radiosity/geometry/rectangle_packing.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/corner_radiosity.h"
#include "radiosity/textures/file_names.h"
#include "raster/base/input_error.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

std::vector<glm::ivec2> randomGrids(std::size_t count, int largest) {
  std::mt19937 random(7);
  std::vector<glm::ivec2> grids;
  for (std::size_t i = 0; i < count; ++i)
    grids.emplace_back(1 + static_cast<int>(random() % static_cast<unsigned>(largest)),
                       1 + static_cast<int>(random() % static_cast<unsigned>(largest)));
  return grids;
}

/// The pixel of a texture at a column and a row counted from the bottom.
glm::dvec3 pixelAt(const Image& image, int column, int row) {
  return image.pixels[static_cast<std::size_t>((image.height - 1 - row) * image.width + column)];
}

glm::dvec3 elementValue(std::uint32_t element) { return glm::dvec3(1.0 + element, 0.5 * element, 1.0 / (1 + element)); }

std::vector<glm::dvec3> elementValues(const Discretization& discretization) {
  std::vector<glm::dvec3> values;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) values.push_back(elementValue(e));
  return values;
}

bool isSame(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) <= 1e-14 * glm::length(b); }

}  // namespace

TEST_CASE("packRectangles puts rectangles, also equal ones, inside their pages without overlap", "[texture]") {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<RectangleSize> sizes;
    const unsigned largest =
        round % 2 ? 70 : 4;  // small sizes give many equal rectangles; some large ones exceed the page
    for (unsigned i = 0; i < 20 + random() % 300; ++i)
      sizes.push_back({1 + static_cast<int>(random() % largest), 1 + static_cast<int>(random() % largest)});
    const Packing packing = packRectangles(sizes, 64);
    std::vector<std::vector<bool>> taken;
    for (const RectangleSize& page : packing.pages)
      taken.emplace_back(static_cast<std::size_t>(page.width * page.height), false);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const RectanglePlace& place = packing.places[i];
      const auto page = static_cast<std::size_t>(place.page);
      REQUIRE((place.column >= 0 && place.column + sizes[i].width <= packing.pages[page].width));
      REQUIRE((place.row >= 0 && place.row + sizes[i].height <= packing.pages[page].height));
      for (int y = place.row; y < place.row + sizes[i].height; ++y)
        for (int x = place.column; x < place.column + sizes[i].width; ++x) {
          const auto pixel = static_cast<std::size_t>(y * packing.pages[page].width + x);
          REQUIRE_FALSE(taken[page][pixel]);
          taken[page][pixel] = true;
        }
    }
  }
}

TEST_CASE("packRectangles makes the last page the smallest power of two that holds the rest", "[texture]") {
  const auto sides = [](std::size_t count, int side) {
    std::vector<int> result;
    for (const RectangleSize& page : packRectangles(std::vector<RectangleSize>(count, {side, side}), 64).pages) {
      CHECK(page.width == page.height);
      result.push_back(page.width);
    }
    return result;
  };
  CHECK(sides(1, 1) == std::vector{1});
  CHECK(sides(16, 8) == std::vector{32});
  CHECK(sides(17, 8) == std::vector{64});
  CHECK(sides(65, 8) == std::vector{64, 8});
  CHECK(sides(1, 64) == std::vector{64});
  CHECK(sides(1, 65) == std::vector{65});
  CHECK(sides(0, 1).empty());
}

TEST_CASE("packRectangles puts the earlier of equal rectangles lower, then further left", "[texture]") {
  const Packing packing = packRectangles(std::vector<RectangleSize>(4096, {1, 1}), 64);
  REQUIRE(packing.pages.size() == 1);
  for (int i = 0; i < 4096; ++i) {
    REQUIRE(packing.places[static_cast<std::size_t>(i)].row == i / 64);
    REQUIRE(packing.places[static_cast<std::size_t>(i)].column == i % 64);
  }
}

TEST_CASE("uniqueFileNames converts names of surfaces to different file names", "[texture]") {
  const std::vector<std::string> names =
      uniqueFileNames({"wall", "Wall", "a b/c#1", "wall-2", "", "..", "render", "\xc3\xa9"}, {"render"});
  CHECK(names == std::vector<std::string>{"wall", "Wall-2", "a_b_c_1", "wall-2-2", "_", "_..", "render-2", "__"});
  CHECK(uniqueFileNames({std::string(300, 'x')}).front().size() == 100);
}

TEST_CASE("radiosityTextures puts the elements at the pixel centres of their texels", "[texture]") {
  const ChartScene charts = makeCharts(randomGrids(100, 9));
  for (std::size_t limit : {std::size_t{0}, std::size_t{100}}) {
    const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {1}, limit);
    const std::vector<Image> textures =
        radiosityTextures(charts.discretization, layout, elementValues(charts.discretization));
    for (std::uint32_t s = 0; s < 100; ++s) {
      const Grid& grid = charts.discretization.grids[s];
      const Image& texture = textures[static_cast<std::size_t>(layout.places[s].texture)];
      for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
          const glm::dvec2 uv = textureCoordinate(charts.discretization, layout, s,
                                                  {(column + 0.5) / grid.columns, (row + 0.5) / grid.rows});
          const double x = uv.x * texture.width - 0.5, y = uv.y * texture.height - 0.5;
          REQUIRE(x == Approx(layout.places[s].column + column).margin(1e-9));
          REQUIRE(y == Approx(layout.places[s].row + row).margin(1e-9));
          const auto element = grid.firstElement + static_cast<std::uint32_t>(row * grid.columns + column);
          REQUIRE(pixelAt(texture, static_cast<int>(x + 0.5), static_cast<int>(y + 0.5)) == elementValue(element));
        }
    }
  }
}

TEST_CASE("radiosityTextures and filteredTexture repeat the edge in the border", "[texture]") {
  const ChartScene charts = makeCharts({{5, 3}, {1, 1}, {1, 4}, {2, 2}});
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {1}, 0);
  const std::vector<glm::dvec3> values = elementValues(charts.discretization);
  for (const Image& texture :
       {radiosityTextures(charts.discretization, layout, values)[0],
        filteredTexture(charts.scene, charts.discretization, layout, 0, values, TextureFilter::Triangle)})
    for (std::size_t s = 0; s < 4; ++s) {
      const Grid& grid = charts.discretization.grids[s];
      const TexturePlace& place = layout.places[s];
      for (int r = -1; r <= grid.rows; ++r)
        for (int c = -1; c <= grid.columns; ++c) {
          const int column = std::clamp(c, 0, grid.columns - 1), row = std::clamp(r, 0, grid.rows - 1);
          REQUIRE(pixelAt(texture, place.column + c, place.row + r) ==
                  pixelAt(texture, place.column + column, place.row + row));
        }
    }
}

TEST_CASE("filteredTexture takes no light from neighbouring charts, for all filters and magnifications", "[texture]") {
  // Packed charts of constants so different that a trace of another is visible; sampled bilinearly anywhere in [0,
  // 1]^2.
  const ChartScene charts = makeCharts(randomGrids(60, 6));
  const std::array<double, 3> levels{0, 1, 1e30};
  std::vector<glm::dvec3> values(charts.discretization.elements.size());
  for (std::uint32_t e = 0; e < values.size(); ++e)
    values[e] = glm::dvec3(levels[charts.discretization.elements[e].surface % 3]);
  for (const TextureFilter filter : {TextureFilter::OneToOne, TextureFilter::Triangle, TextureFilter::Bilinear,
                                     TextureFilter::Bicubic, TextureFilter::Quadtree, TextureFilter::Gouraud})
    for (const int times : {1, 2, 5}) {
      const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {times}, 0);
      const Image texture = filteredTexture(charts.scene, charts.discretization, layout, 0, values, filter);
      CHECK(texture.width == times * layout.textures[0].width);
      for (std::uint32_t s = 0; s < 60; ++s)
        for (const double v : {0.0, 0.01, 0.3, 0.5, 1.0})
          for (const double u : {0.0, 0.2, 0.5, 0.99, 1.0}) {
            const glm::dvec2 uv = textureCoordinate(charts.discretization, layout, s, {u, v});
            const glm::dvec2 place = uv * glm::dvec2(texture.width, texture.height) - 0.5;
            const glm::ivec2 low(glm::floor(place));
            for (const int i : {low.x, low.x + 1})
              for (const int j : {low.y, low.y + 1})
                REQUIRE(pixelAt(texture, i, j).x == Approx(levels[s % 3]).epsilon(1e-13).margin(0));
          }
    }
}

TEST_CASE("filteredTexture refuses a texture that could not be read again", "[texture]") {
  const ChartScene charts = makeCharts({{1100, 1100}});
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {16});
  CHECK_THROWS_AS(filteredTexture(charts.scene, charts.discretization, layout, 0, {}, TextureFilter::Triangle),
                  raster::InputError);
}

TEST_CASE("radiosityTextures show the nearest element at texels without area", "[texture]") {
  ChartScene charts{sceneOf({parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}), {}};
  addGrid(charts.discretization, 3, 2, {true, true, true, true, true, false});
  charts.discretization.grids[0].elementOfTexel[5] = 4;
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {1});
  const std::vector<glm::dvec3> values = elementValues(charts.discretization);
  const Image plain = radiosityTextures(charts.discretization, layout, values)[0];
  CHECK(pixelAt(plain, 3, 2) == pixelAt(plain, 2, 2));
  const Image filtered =
      filteredTexture(charts.scene, charts.discretization, layout, 0, values, TextureFilter::Triangle);
  CHECK(pixelAt(filtered, 3, 2) == pixelAt(filtered, 2, 2));
}

TEST_CASE("filteredTexture of a constant is the constant, also at edges and around holes", "[texture]") {
  std::mt19937 random(3);
  ChartScene charts;
  std::vector<bool> covered;
  for (int i = 0; i < 15 * 11; ++i) covered.push_back(random() % 3 != 0);
  addGrid(charts.discretization, 15, 11, covered);
  addGrid(charts.discretization, 1, 1);
  charts.scene = sceneOf({parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),  //
                          parallelogram("b", {0, 0, 1}, {1, 0, 0}, {0, 1, 0})});
  const glm::dvec3 constant(0.1, 0.7, 123.456);
  const std::vector<glm::dvec3> values(charts.discretization.elements.size(), constant);
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {1});
  for (std::size_t t = 0; t < layout.textures.size(); ++t)
    for (const glm::dvec3& pixel :
         filteredTexture(charts.scene, charts.discretization, layout, t, values, TextureFilter::Triangle).pixels)
      REQUIRE(isSame(pixel, constant));
}

TEST_CASE("filteredTexture spreads a texel as (1 2 1) x (1 2 1) / 16 and keeps its sum", "[texture]") {
  const ChartScene charts = makeCharts({{7, 7}});
  std::vector<glm::dvec3> values(49, glm::dvec3(0.0));
  values[3 * 7 + 2] = glm::dvec3(16, 32, 48);  // two texels from the edge, so that weights are not normalized again
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {1});
  const Image texture =
      filteredTexture(charts.scene, charts.discretization, layout, 0, values, TextureFilter::Triangle);
  glm::dvec3 sum(0.0);
  for (int row = 1; row <= 7; ++row)
    for (int column = 1; column <= 7; ++column) sum += pixelAt(texture, column, row);
  CHECK(sum == glm::dvec3(16, 32, 48));
  CHECK(pixelAt(texture, 3, 4) == glm::dvec3(4, 8, 12));
  CHECK(pixelAt(texture, 4, 4) == glm::dvec3(2, 4, 6));
  CHECK(pixelAt(texture, 2, 5) == glm::dvec3(1, 2, 3));
  CHECK(pixelAt(texture, 5, 4) == glm::dvec3(0.0));
}

TEST_CASE("displayRadiosity adds the ambient estimate times reflectance", "[texture]") {
  ChartScene charts = makeCharts({{2, 1}});
  charts.scene.materials[0].reflectance = {0.5, 0.25, 0};
  Solution solution;
  solution.radiosity = {{1, 2, 3}, {0, 0, 0}};
  solution.ambient = {8, 8, 8};
  CHECK(displayRadiosity(charts.scene, charts.discretization, solution) ==
        std::vector<glm::dvec3>{{5, 4, 3}, {4, 2, 0}});
}

TEST_CASE("cornerRadiosity averages over smooth neighbours of the same material by area", "[texture]") {
  // At the corner (1,0,0): a has area 1; b has area 2, beside it in the same plane; c is bent by 90 degrees; d is bent
  // by about 11 degrees; e is as b but of another material; f is as b but discretized.
  const Surface a = parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Surface b = parallelogram("b", {1, 0, 0}, {2, 0, 0}, {0, 1, 0});
  const Surface c = parallelogram("c", {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  const Surface d = parallelogram("d", {1, -1, 0}, {1, 0, 0.2}, {0, 1, 0});
  Surface e = parallelogram("e", {1, 0, 0}, {2, 0, 0}, {0, 1, 0});
  e.material = 1;
  const Surface f = parallelogram("f", {1, 0, 0}, {2, 0, 0}, {0, 1, 0});
  const Scene scene = sceneOf({a, b, c, d, e, f}, {Material{}, Material{}});
  Discretization discretization;
  for (int i = 0; i < 5; ++i) addGrid(discretization, 1, 1);
  addGrid(discretization, 2, 2);
  std::vector<glm::dvec3> values(9, glm::dvec3(1e6));
  for (std::size_t i = 0; i < 5; ++i) values[i] = glm::dvec3(static_cast<double>(1 << i));

  const auto corners = cornerRadiosity(scene, discretization, values);
  REQUIRE(corners.size() == 6);
  // At (1,0,0) meet: one triangle of a (area 1/2, value 1); both of b (area 1 each, value 2); the upper one of d (area
  // sqrt(1.04)/2, value 8).
  const double slope = std::sqrt(1.04) / 2;
  const double expected = (0.5 * 1 + 2 * 2 + slope * 8) / (0.5 + 2 + slope);
  CHECK(corners[0][0][1].x == Approx(expected).epsilon(1e-14));
  CHECK(corners[1][0][0].x == Approx(expected).epsilon(1e-14));
  CHECK(corners[0][0][0].x == 1);   // (0,0,0) belongs only to a
  CHECK(corners[2][0][0].x == 4);   // c is bent too far
  CHECK(corners[4][0][0].x == 16);  // e has another material
  CHECK(corners[5].empty());
}
