// Elements, patches and texel-to-element maps of whole scenes.
#include "radiosity/discretization/discretize.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <span>

#include "radiosity/discretization/grid_size.h"
#include "radiosity/discretization/sliver_merging.h"
#include "radiosity/discretization/texel_areas.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"
#include "raster/base/parallel.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// The paper's room as Figure 2 counts it: six walls, six faces of a box inside, one light.
Scene paperRoom() {
  std::vector<Surface> surfaces = box("wall", {0, 0, 0}, {4, 3, 4}, true);
  for (Surface& face : box("box", {1, 0.5, 1}, {1, 1, 1}, false)) surfaces.push_back(face);
  surfaces.push_back(parallelogram("light", {1.5, 2.9, 1.5}, {1, 0, 0}, {0, 0, 1}));
  for (Surface& surface : surfaces) surface.family = surface.name.substr(0, surface.name.find_first_of("0123456789"));
  return sceneOf(surfaces);
}

struct Counts {
  int wall, box, patch;
  std::size_t elements;
};

double sumOfAreas(const Discretization& discretization, std::uint32_t surface) {
  long double sum = 0;
  for (const Element& element : discretization.elements)
    if (element.surface == surface) sum += element.area;
  return static_cast<double>(sum);
}

/// Whether the block of texels of a patch contains the texel.
bool holds(const Patch& patch, const Grid& grid, std::uint32_t texel) {
  const int column = int(texel) % grid.columns, row = int(texel) / grid.columns;
  return column >= patch.column && column < patch.column + patch.width && row >= patch.row &&
         row < patch.row + patch.height;
}

bool equal(const Discretization& a, const Discretization& b) {
  const auto sameGrid = [](const Grid& g, const Grid& h) {
    return g.elementOfTexel == h.elementOfTexel && g.covered == h.covered && g.firstPatch == h.firstPatch;
  };
  const auto sameElement = [](const Element& e, const Element& f) {
    return e.area == f.area && e.surface == f.surface && e.texel == f.texel;
  };
  return std::equal(a.grids.begin(), a.grids.end(), b.grids.begin(), b.grids.end(), sameGrid) &&
         std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(), sameElement) &&
         a.patches.ofElement == b.patches.ofElement && a.triangleOf == b.triangleOf;
}

}  // namespace

TEST_CASE("discretize of the paper's room has the paper's number of elements at each level, and 61 patches",
          "[discretization]") {
  const Scene scene = paperRoom();
  // Figure 2 (e), then coarse, medium and fine of Table 1: six walls and six box faces of N^2 elements, one light.
  for (const Counts& level : {Counts{8, 3, 1, 439}, {6, 2, 2, 241}, {12, 4, 4, 961}, {24, 8, 8, 3841}}) {
    const Discretization discretization = discretize(
        scene, {.texels = level.wall, .surfaceTexels = {{"box", level.box}, {"light", 1}}, .patch = level.patch});
    CHECK(discretization.elements.size() == level.elements);
    if (level.patch > 1) CHECK(discretization.patches.list.size() == 61);
    CHECK_FALSE(isDiscretized(discretization.grids.back()));
  }
}

TEST_CASE("discretize gives elements the surface's area, and maps each texel to one element", "[discretization]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  for (const int texels : {1, 2, 9, 32, 100}) {
    const Discretization discretization = discretize(scene, {.texels = texels, .patch = 3});
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      INFO(scene.surfaces[s].name << " with " << texels << " texels");
      const Grid& grid = discretization.grids[s];
      CHECK(sumOfAreas(discretization, s) == Approx(totalArea(scene.surfaces[s])).epsilon(1e-12));
      CHECK(std::uint32_t(std::count(grid.covered.begin(), grid.covered.end(), false)) == grid.phantoms);
      for (const std::uint32_t number : grid.elementOfTexel) {
        REQUIRE(number - grid.firstElement < grid.elementCount);
        const Element& element = discretization.elements[number];
        REQUIRE(element.surface == s);
        REQUIRE(grid.covered[element.texel]);
        REQUIRE(grid.elementOfTexel[element.texel] == number);
        REQUIRE(element.area > 0);
      }
    }
  }
}

TEST_CASE("discretize exposes surfaces up to their common edge, however acute the angle", "[discretization]") {
  for (const double degrees : {1.0, 5.0, 30.0, 90.0, 175.0}) {
    CAPTURE(degrees);
    const double angle = degrees / 180 * 3.14159265358979323846;
    const Scene scene = sceneOf({parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                 parallelogram("over", {0, 0, 0}, {0, std::cos(angle), std::sin(angle)}, {1, 0, 0})});
    for (const int texels : {1, 5}) {
      const Discretization discretization = discretize(scene, {.texels = texels});
      for (std::uint32_t s = 0; s < 2; ++s) CHECK(sumOfAreas(discretization, s) == Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("discretize buries a floor under a pyramid, up to its outline", "[discretization]") {
  // The outline lies in the floor, and off the borders of texels. A sunk pyramid has a smaller outline: at half its
  // height it is half as wide.
  const std::array<glm::dvec2, 4> base{{{0.21, 0.23}, {0.71, 0.23}, {0.71, 0.73}, {0.21, 0.73}}};
  for (const double sunk : {0.0, 0.25})
    for (const int texels : {1, 4, 16}) {
      CAPTURE(sunk, texels);
      std::vector<Surface> surfaces{parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
      for (std::size_t side = 0; side < 4; ++side) {
        const Corner a{{base[side], -sunk}, {0, 0}}, b{{base[(side + 1) % 4], -sunk}, {1, 0}};
        surfaces.push_back(
            surfaceOf("side" + std::to_string(side), {triangleOf(a, b, {{0.46, 0.48, 0.5 - sunk}, {0, 1}})}));
      }
      const Discretization discretization = discretize(sceneOf(surfaces), {.texels = texels});
      const double width = 0.5 * (1 - sunk / 0.5);
      CHECK(sumOfAreas(discretization, 0) == Approx(1 - width * width).epsilon(1e-9));
    }
}

TEST_CASE("discretize covers each element at least a quarter of a texel, unless it has no neighbour",
          "[discretization]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  for (const int texels : {3, 16, 50}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      const Grid& grid = discretization.grids[s];
      const std::vector<double> coverage = texelAreas(scene.surfaces[s], texelGrid(grid)).coverage;
      std::vector<double> ofElement(grid.elementCount);
      for (std::size_t texel = 0; texel < coverage.size(); ++texel)
        ofElement[grid.elementOfTexel[texel] - grid.firstElement] += coverage[texel];
      for (std::size_t texel = 0; texel < coverage.size(); ++texel) {
        if (!grid.covered[texel] || ofElement[grid.elementOfTexel[texel] - grid.firstElement] >= 0.25 - 1e-9) continue;
        for (std::size_t other = 0; other < coverage.size(); ++other) {
          const int dx = int(other) % texels - int(texel) % texels, dy = int(other) / texels - int(texel) / texels;
          if (grid.covered[other] && std::abs(dx) <= 1 && std::abs(dy) <= 1)
            REQUIRE(grid.elementOfTexel[other] == grid.elementOfTexel[texel]);
        }
      }
    }
  }
}

TEST_CASE("discretize distributes the elements to patches by blocks of texels, none empty", "[discretization]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  for (const int side : {1, 3, 4, 1000}) {
    const Discretization discretization = discretize(scene, {.texels = 14, .patch = side});
    std::vector<int> seen(discretization.elements.size());
    for (std::uint32_t p = 0; p < discretization.patches.list.size(); ++p) {
      const Patch& patch = discretization.patches.list[p];
      const Grid& grid = discretization.grids[patch.surface];
      REQUIRE(patch.number == p);
      REQUIRE(!patch.elements.empty());
      REQUIRE(p - grid.firstPatch < grid.patchCount);
      REQUIRE((patch.width <= side && patch.column + patch.width <= 14 && patch.column % side == 0));
      REQUIRE((patch.height <= side && patch.row + patch.height <= 14 && patch.row % side == 0));
      REQUIRE(std::is_sorted(patch.elements.begin(), patch.elements.end()));
      for (const std::uint32_t element : patch.elements) {
        REQUIRE(discretization.patches.ofElement[element] == p);
        REQUIRE(holds(patch, grid, discretization.elements[element].texel));
        ++seen[element];
      }
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  }
}

TEST_CASE("discretize of a wall of 6 x 6 texels in an 8 x 8 chart leaves 28 phantoms", "[discretization]") {
  // Figure 2: one 8 x 8 index map for all surfaces; a 6 x 6 wall uses its lower left.
  const Scene scene = sceneOf({flat("wall", rectangle({0, 0}, {0.75, 0.75}))});
  const Discretization discretization = discretize(scene, {.texels = 8});
  CHECK(discretization.elements.size() == 36);
  CHECK(discretization.grids[0].phantoms == 28);
}

TEST_CASE("discretize prefers the texels of a name to those of a family, and both to the default", "[discretization]") {
  const Scene scene = paperRoom();
  const Discretization discretization =
      discretize(scene, {.texels = 5, .texelSize = 0.5, .surfaceTexels = {{"wall", 3}, {"wall2", 7}}});
  CHECK(discretization.grids[0].columns == 3);
  CHECK(discretization.grids[2].columns == 7);
  CHECK(discretization.grids[2].rows == 7);
  CHECK(discretization.grids[6].columns == 2);  // a box face: 1 / 0.5
}

TEST_CASE("discretize with a texel size makes as few texels as possible that are at most that long",
          "[discretization]") {
  const auto sizeOf = [](const Surface& surface, double texelSize) {
    const Grid grid = discretize(sceneOf({surface}), {.texelSize = texelSize}).grids[0];
    return std::pair(grid.columns, grid.rows);
  };
  const Surface wall = parallelogram("wall", {0, 0, 0}, {3, 0, 0}, {0, 0.7, 0});
  CHECK(sizeOf(wall, 0.1) == std::pair(30, 7));
  CHECK(sizeOf(wall, 0.3) == std::pair(10, 3));
  CHECK(sizeOf(wall, 0.299) == std::pair(11, 3));
  // Coordinates rounded to binary32 may give a length of 3 + 2e-7 instead of 3, which must not add a texel.
  CHECK(sizeOf(parallelogram("wall", {0, 0, 0}, {3 + 2e-7, 0, 0}, {0, 1, 0}), 0.1) == std::pair(30, 10));
  CHECK(sizeOf(wall, 5) == std::pair(1, 1));
  CHECK(sizeOf(parallelogram("thread", {0, 0, 0}, {3, 0, 0}, {0, 1e-9, 0}), 1e-6) == std::pair(4096, 1));
  // A mirrored chart has the same lengths.
  Surface mirrored = wall;
  for (Triangle& triangle : mirrored.triangles)
    for (glm::dvec2& chart : triangle.chart) chart.x = 1 - chart.x;
  CHECK(sizeOf(mirrored, 0.1) == std::pair(30, 7));
  // The length of the chart's axes counts, not the used part of the chart.
  CHECK(sizeOf(flat("corner", rectangle({0.25, 0.25}, {0.5, 0.75})), 0.125) == std::pair(8, 8));
}

TEST_CASE("discretize makes one element of a surface whose chart collapses to a point", "[discretization]") {
  const Surface surface =
      surfaceOf("point", {triangleOf({{0, 0, 0}, {0.3, 0.3}}, {{1, 0, 0}, {0.3, 0.3}}, {{0, 1, 0}, {0.3, 0.3}})});
  const Discretization discretization = discretize(sceneOf({surface}), {.texels = 8});
  REQUIRE(discretization.elements.size() == 1);
  CHECK(discretization.elements[0].area == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("discretize throws InputError for settings out of range and names without a surface", "[discretization]") {
  const Scene scene = paperRoom();
  const auto fails = [&](const DiscretizationSettings& settings) {
    try {
      discretize(scene, settings);
      return false;
    } catch (const raster::InputError& error) {
      return !error.advice().empty();
    }
  };
  CHECK(fails({.texels = 0}));
  CHECK(fails({.texels = 4097}));
  CHECK(fails({.texelSize = 0.0}));
  CHECK(fails({.texelSize = std::nan("")}));
  CHECK(fails({.texelSize = -1.0}));
  CHECK(fails({.texelSize = INFINITY}));
  CHECK(fails({.patch = 0}));
  CHECK(fails({.surfaceTexels = {{"wall", 0}}}));
  CHECK(fails({.surfaceTexels = {{"ceiling", 4}}}));
  CHECK_FALSE(fails({.surfaceTexels = {{"light", 1}, {"wall", 4096 / 64}}}));
}

TEST_CASE("discretize refuses more texels than item IDs before it allocates memory", "[discretization]") {
  const Scene scene = sceneOf(std::vector<Surface>(256, flat("wall", rectangle({0, 0}, {1, 1}))));
  CHECK_THROWS_WITH(discretize(scene, {.texels = 4096}), Catch::Contains("4294967296 texels"));
}

TEST_CASE("discretize refuses more than 2^24 elements, unless the user insists", "[discretization]") {
  Scene scene = sceneOf(std::vector<Surface>(2, flat("wall", rectangle({0, 0}, {1, 1}))));
  scene.files = {"walls.obj"};
  const raster::SizePolicy policy(false, "insist");
  CHECK_THROWS_WITH(discretize(scene, {.texelSize = 1e-9}),
                    Catch::StartsWith("walls.obj: the scene becomes 33554432 elements, more than 16777216; they take "
                                      "about 3.36 GB of memory") &&
                        Catch::EndsWith("; use larger texels, or insist"));
  const std::vector<GridSize> sizes{{4096, 4096}, {1, 1}};
  CHECK_NOTHROW(requireAffordable(scene, std::span(sizes).first(1)));
  CHECK_THROWS_AS(requireAffordable(scene, sizes), raster::SizeError);
  const raster::SizePolicy insisting(true, "");
  CHECK_NOTHROW(requireAffordable(scene, sizes));
}

TEST_CASE("discretize gives the same result for any number of threads", "[discretization]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  const Discretization parallel = discretize(scene, {.texels = 40});
  const raster::ThreadLimit one(1);
  CHECK(equal(parallel, discretize(scene, {.texels = 40})));
}
