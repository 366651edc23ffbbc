// The maximum number of surfaces for the item IDs: the number, the error for one more, and that each surface is drawn
// with its own item IDs.
#include <bit>
#include <catch2/catch.hpp>
#include <fstream>
#include <numeric>
#include <set>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using raster::ItemId;

namespace {

Discretization gridsOf(std::uint64_t count, int columns, int rows) {
  Discretization discretization;
  Grid grid;
  grid.columns = columns;
  grid.rows = rows;
  discretization.grids.assign(count, grid);
  return discretization;
}

bool fits(std::uint64_t count, int columns, int rows, const std::string& format) {
  try {
    layOut(gridsOf(count, columns, rows), {.format = format});
    return true;
  } catch (const raster::InputError&) {
    return false;
  }
}

/// A wall of side x side squares that fills a view along z from the origin. Each square is a draw with its own offset;
/// all share one index map of texels x texels. The last draw is left out if its last item IDs are reserved.
raster::DrawList wallOf(int side, int texels, const std::string& format) {
  raster::DrawList list;
  list.format = *raster::formatNamed(format);
  list.indexMaps = {{texels, texels, std::vector<ItemId>(std::size_t(texels * texels))}};
  std::iota(list.indexMaps[0].ids.begin(), list.indexMaps[0].ids.end(), ItemId{0});
  const auto at = [&](int i) { return float(-1 + 2.0 * i / side); };
  const std::uint64_t count = std::min<std::uint64_t>(std::uint64_t(side) * std::uint64_t(side),
                                                      maxSurfaces(list.format, std::uint64_t(texels * texels)));
  for (std::uint64_t draw = 0; draw < count; ++draw) {
    const int column = int(draw) % side, row = int(draw) / side;
    const auto first = std::uint32_t(list.positions.size());
    for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      list.positions.emplace_back(at(column + i), at(row + j), 1.0f);
      list.texcoords.emplace_back(float(i), float(j));
    }
    list.draws.push_back({.first = std::uint32_t(list.indices.size()),
                          .count = 6,
                          .offset = ItemId(draw) * ItemId(texels * texels),
                          .back = raster::backId(list.format),
                          .indexMap = 0});
    for (const std::uint32_t corner : {0u, 2u, 1u, 0u, 3u, 2u}) list.indices.push_back(first + corner);
  }
  return list;
}

/// The number of pixels whose item ID is not that of the texel at their middle. With `resolution`, no sample is nearer
/// to a border between texels than snapping moves it.
std::size_t wrongPixels(raster::DrawList list, int side, int texels, int resolution) {
  const auto draws = list.draws.size();
  const ItemId background = raster::backgroundId(list.format);
  raster::SoftwareRenderer renderer(std::move(list));
  const raster::Face face{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.1f, resolution, {0, 0, resolution, resolution}};
  const raster::ItemBuffer buffer = render(renderer, {&face, 1}, {}).front();
  const auto texelAt = [&](int pixel) {  // of all squares' in a row
    return (2 * std::int64_t{pixel} + 1) * side * texels / (2 * resolution);
  };
  std::size_t wrong = 0;
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i) {
      const std::int64_t column = texelAt(i), row = texelAt(j);
      const std::int64_t draw = row / texels * side + column / texels;
      const ItemId id = ItemId(draw * texels * texels + row % texels * texels + column % texels);
      const ItemId expected = draw < std::int64_t(draws) ? id : background;
      wrong += buffer.ids[std::size_t(j) * std::size_t(resolution) + std::size_t(i)] != expected ? 1 : 0;
    }
  return wrong;
}

}  // namespace

TEST_CASE("maxSurfaces is the number of surfaces that layOut accepts, and one more is an error", "[many surfaces]") {
  struct Limit {
    std::string format;
    int columns, rows;
    std::uint64_t surfaces;
  };
  // 2^m item IDs minus two; maps of 2^k texels allow 2^(m-k) - 1 surfaces. 9 texels take 16 item IDs, but those of the
  // last surface only 9: 65534 = 4095 * 16 + 14. 255 x 257 = 65535 texels are one item ID too many.
  const std::vector<Limit> limits{
      {"r5g6b5", 1, 1, 65534},          {"r5g6b5", 2, 2, 16383},       {"r5g6b5", 3, 3, 4096},
      {"r5g6b5", 16, 16, 255},          {"r5g6b5", 64, 64, 15},        {"r5g6b5", 255, 256, 1},
      {"r5g6b5", 255, 257, 0},          {"r8g8b8", 16, 16, 65535},     {"r8g8b8", 64, 64, 4095},
      {"r8g8b8", 63, 64, 4096},         {"r8g8b8", 256, 256, 255},     {"r8g8b8a8", 64, 64, 1048575},
      {"r10g10b10a2", 64, 64, 1048575}, {"r8g8b8a8", 256, 256, 65535}, {"r32ui", 4096, 4096, 255}};
  for (const Limit& limit : limits) {
    INFO(limit.format << ", " << limit.columns << " x " << limit.rows);
    CHECK(maxSurfaces(*raster::formatNamed(limit.format), std::uint64_t(limit.columns) * std::uint64_t(limit.rows)) ==
          limit.surfaces);
    if (limit.surfaces > 0) CHECK(fits(limit.surfaces, limit.columns, limit.rows, limit.format));
    CHECK_FALSE(fits(limit.surfaces + 1, limit.columns, limit.rows, limit.format));
  }
}

TEST_CASE("maxSurfaces agrees with the table of docs/item-buffers.md", "[many surfaces]") {
  std::ifstream page(std::string(HEMITEX_DOCS) + "/item-buffers.md");
  std::set<std::string> lines;
  for (std::string line; std::getline(page, line);) lines.insert(line);
  for (const std::uint64_t side : {1u, 2u, 8u, 16u, 64u, 256u, 4096u}) {
    const std::uint64_t texels = side * side;
    const std::string name = std::to_string(side) + " x " + std::to_string(side);
    std::string row = "| " + name + " | " + std::to_string(std::bit_width(texels - 1)) + " |";
    for (const char* format : {"r5g6b5", "r8g8b8", "r8g8b8a8"})
      row += " " + std::to_string(maxSurfaces(*raster::formatNamed(format), texels)) + " |";
    INFO(row);
    CHECK(lines.count(row) == 1);
  }
}

TEST_CASE("SoftwareRenderer draws as many surfaces as 16 bits hold, each with its own item IDs", "[many surfaces]") {
  // 128 x 128 squares of 2 x 2 texels, one pixel each, without the last square, whose last item IDs are reserved.
  CHECK(wallOf(128, 2, "r5g6b5").draws.size() == 16383);
  CHECK(wrongPixels(wallOf(128, 2, "r5g6b5"), 128, 2, 256) == 0);
  // One more is refused when it is drawn.
  raster::DrawList list = wallOf(128, 2, "r5g6b5");
  list.draws.back().offset += 4;
  CHECK_THROWS_AS(raster::SoftwareRenderer(list), raster::InputError);
}

TEST_CASE("SoftwareRenderer draws a million maps of 64 x 64 texels in 32 bits, with the right item ID in each pixel",
          "[.million]") {
  // 1000 x 1000 squares over 2048 x 2048 pixels: a square is 524 sub-pixels (1/256 pixel) wide, and a texel 8.2.
  // Samples lie at odd multiples of 125/8 texels, at least an eighth of a texel from all borders. That is one
  // sub-pixel, and snapping moves a border by half of one.
  raster::DrawList list = wallOf(1000, 64, "r8g8b8a8");
  CHECK(list.draws.size() == 1000000);
  CHECK(list.draws.back().offset == 999999u * 4096);
  CHECK(wrongPixels(std::move(list), 1000, 64, 2048) == 0);
}

TEST_CASE("solve of a million surfaces of 2 x 2 texels balances its account", "[.million]") {
  // A floor emits under a ceiling of 1000 x 1000 squares, each a surface with a map and an offset. The floor's shot
  // from its centre equals the closed form of the ceiling. The shots of the brightest patches of the ceiling and the
  // lost light balance the account.
  constexpr int side = 1000;
  const auto at = [](int i) { return double(i) / side; };
  std::vector<Surface> surfaces{parallelogram("floor", {}, {1, 0, 0}, {0, 1, 0})};
  for (int i = 0; i < side * side - 1; ++i) {
    const int column = i % side, row = i / side;
    surfaces.push_back(quad("tile" + std::to_string(i), {glm::dvec3(at(column), at(row), 1),
                                                         {at(column), at(row + 1), 1},
                                                         {at(column + 1), at(row + 1), 1},
                                                         {at(column + 1), at(row), 1}}));
  }
  Scene scene = sceneOf(std::move(surfaces));
  scene.materials.push_back(Material{.name = "light", .reflectance = glm::dvec3(0.5), .emission = glm::dvec3(1)});
  scene.surfaces[0].material = int(scene.materials.size()) - 1;
  scene.materials[0].reflectance = glm::dvec3(0.5);
  Discretization discretization = discretize(scene, {.texels = 2, .patch = 2});
  CHECK(discretization.elements.size() == 4000000);
  IdLayout layout = layOut(discretization);
  CHECK(layout.textured == 1000000);
  SceneFormFactors drawn(scene, discretization, std::move(layout), {.resolution = 1024, .split = 1});
  const Solution solution = solve({.scene = scene,
                                   .discretization = discretization,
                                   .patches = discretization.patches,
                                   .rowOf = drawn.rowOf(),
                                   .settings = {.shots = 3}});
  CHECK(solution.shots == 3);
  const Energy& energy = solution.energy;
  CHECK(energy.absorbed[0] + energy.unshot[0] + energy.lost[0] + energy.lostToBacks[0] ==
        Approx(energy.emitted[0]).epsilon(1e-12));
  // The first shot is that of the floor, from its centre. The light that left through the sides of the room is 1 minus
  // the closed form. Two squares of a millionth of the area send a millionth of that back.
  const std::vector<glm::dvec3> ceiling{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const double arrived = reference::pointToPolygon({0.5, 0.5, 0}, {0, 0, 1}, ceiling);
  CHECK(energy.lost[0] == Approx(1 - arrived).epsilon(0.002));
}
