// Grid sizes of surfaces, and texel sizes that fill pages.
#include "radiosity/discretization/grid_size.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

Scene dataScene(const std::string& name) { return loadScene(std::string(HEMITEX_DATA) + "/" + name + ".obj"); }

/// A quarter of a cylinder of radius 1 and the given height: the axes of its chart are pi/2 and the height long.
Surface cylinder(double height) {
  constexpr int steps = 64;
  std::vector<Triangle> triangles;
  const auto at = [&](int step, double v) {
    const double angle = 3.14159265358979323846 / 2 * step / steps;
    return Corner{{std::cos(angle), std::sin(angle), height * v}, {double(step) / steps, v}};
  };
  for (int i = 0; i < steps; ++i) {
    triangles.push_back(triangleOf(at(i, 0), at(i + 1, 0), at(i + 1, 1)));
    triangles.push_back(triangleOf(at(i, 0), at(i + 1, 1), at(i, 1)));
  }
  return surfaceOf("cylinder", std::move(triangles));
}

struct Example {
  Surface surface;
  glm::dvec2 lengths;  ///< of the chart's axes
};

std::vector<Example> examples() {
  const auto slanted = [](double width, double height) {
    const glm::dvec3 u = glm::normalize(glm::dvec3(3, -1, 2)), v = glm::normalize(glm::cross(u, glm::dvec3(1, 5, -2)));
    return Example{parallelogram("slanted", {7, -3, 1}, width * u, height * v), {width, height}};
  };
  // A sheared one: its axes are as long as its sides, whatever the angle between them.
  const Example sheared{parallelogram("sheared", {}, {2, 0, 0}, {1, 1, 0}), {2, std::sqrt(2.0)}};
  // A chart that its surface covers partly: the whole axis counts, and texels outside are phantoms.
  const Example part{flat("part", rectangle({0.125, 0.25}, {0.875, 0.5})), {1, 1}};
  return {{parallelogram("square", {}, {1, 0, 0}, {0, 1, 0}), {1, 1}},
          {parallelogram("strip", {}, {5, 0, 0}, {0, 0.11, 0}), {5, 0.11}},
          slanted(0.37, 2.9),
          slanted(1e-3, 1),
          sheared,
          part,
          {flat("triangle", {{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}}), {1, 1}},
          {lShape(), {1, 1}},
          {ring(12), {1, 1}},
          {cylinder(0.7), {64 * 2 * std::sin(3.14159265358979323846 / 256), 0.7}}};
}

}  // namespace

TEST_CASE("gridSizeOf keeps a texel size within a factor of two along each axis of at least that length",
          "[grid size]") {
  for (const Example& example : examples())
    for (double asked = 2; asked > 0.003; asked *= 0.83) {
      const GridSize size = gridSizeOf(example.surface, {.texelSize = asked});
      const glm::dvec2 texel = example.lengths / glm::dvec2(size.columns, size.rows);
      INFO(example.surface.name << ", " << asked << ": " << size.columns << " x " << size.rows);
      for (const int axis : {0, 1}) {
        // Binary32 charts may change a length by a millionth.
        CHECK(texel[axis] <= asked * (1 + 2e-6));
        if (example.lengths[axis] >= asked) CHECK(texel[axis] > asked / 2 * (1 - 2e-6));
        if (example.lengths[axis] < asked) CHECK((axis == 0 ? size.columns : size.rows) == 1);
      }
    }
}

TEST_CASE(
    "discretize makes elements no larger than the texel size, and no smaller than a quarter of a texel, with known "
    "exceptions",
    "[grid size]") {
  // A texel has an area from S^2/4 to S^2, times the sine of the angle between its axes. An element is a texel or its
  // covered part. That part is at least a quarter, or else it merges with a neighbour. Each of the at most eight merged
  // neighbours adds less than a quarter.
  for (const Example& example : examples()) {
    if (example.surface.name == "slanted" || example.surface.name == "strip") continue;  // an axis shorter than S
    for (const double asked : {0.3, 0.17, 0.05}) {
      const Scene scene = sceneOf({example.surface, flat("other", rectangle({0, 0}, {1, 1}))});
      const Discretization discretization = discretize(scene, {.texelSize = asked});
      const Grid& grid = discretization.grids[0];
      const double shear = example.surface.name == "sheared" ? std::sqrt(0.5) : 1;
      INFO(example.surface.name << ", " << asked);
      for (std::uint32_t e = 0; e < grid.elementCount; ++e) {
        const double size = discretization.elements[grid.firstElement + e].area / (asked * asked * shear);
        REQUIRE(size > 1.0 / 16 * (1 - 1e-5));
        REQUIRE(size < 1 + 8.0 / 4);
      }
    }
  }
}

TEST_CASE("discretize makes elements of whole texels within a factor of two of the texel size in all scenes",
          "[grid size]") {
  // In length: the root of an element's area. Only elements with a covered texel, without merged texels, with both axes
  // long enough. Charts of planar parts have no distortion; the others in these scenes have a few percent.
  for (const char* name : {"cornell-box", "paper-room", "pyramid-room", "gallery"}) {
    const Scene scene = dataScene(name);
    const double asked = scene.extent / 40;
    const Discretization discretization = discretize(scene, {.texelSize = asked});
    std::size_t whole = 0, outside = 0;
    for (const Grid& grid : discretization.grids) {
      if (grid.columns < 2 || grid.rows < 2) continue;
      std::vector<int> texels(grid.elementCount);
      for (const std::uint32_t element : grid.elementOfTexel) ++texels[element - grid.firstElement];
      for (std::uint32_t e = 0; e < grid.elementCount; ++e) {
        const Element& element = discretization.elements[grid.firstElement + e];
        if (texels[e] != 1) continue;
        ++whole;
        const double size = std::sqrt(element.area) / asked;
        outside += size < 0.5 || size > 2 ? 1 : 0;
      }
    }
    INFO(name << ": " << outside << " of " << whole);
    CHECK(whole > 100);
    CHECK(double(outside) <= 0.05 * double(whole));
  }
}

TEST_CASE("gridSizeOf with subdivision gives nested grids, and keeps the grids of named surfaces", "[grid size]") {
  const Scene scene = dataScene("pyramid-room");
  const std::string light = scene.surfaces.back().name;
  for (const int subdivision : {2, 3, 4})
    for (const Surface& surface : scene.surfaces) {
      const double size = scene.extent / 13;
      const GridSize coarse = gridSizeOf(surface, {.texelSize = size, .surfaceTexels = {{light, 1}}}),
                     fine = gridSizeOf(surface,
                                       {.texelSize = size, .subdivision = subdivision, .surfaceTexels = {{light, 1}}});
      const int factor = surface.name == light ? 1 : subdivision;
      CHECK(fine.columns == factor * coarse.columns);
      CHECK(fine.rows == factor * coarse.rows);
    }
  CHECK(gridSizeOf(scene.surfaces[0], {.texels = 2048, .subdivision = 3}).columns == 4096);
  CHECK_THROWS_AS(discretize(scene, {.subdivision = 0}), raster::InputError);
}

TEST_CASE("settingsForPages fits the complex scene into eight pages at three levels of detail", "[grid size]") {
  const Scene scene = dataScene("gallery");
  DiscretizationSettings settings = settingsForPages(scene, 8, 64);
  const auto pagesAt = [&](double factor, int subdivision) {
    DiscretizationSettings asked = settings;
    *asked.texelSize *= factor;
    asked.subdivision = subdivision;
    std::vector<RectangleSize> sizes;
    for (const Surface& surface : scene.surfaces) {
      const GridSize grid = gridSizeOf(surface, asked);
      sizes.push_back({grid.columns, grid.rows});
    }
    return packRectangles(sizes, 64 * subdivision).pages.size();
  };
  CHECK(pagesAt(1, 1) == 8);
  CHECK(pagesAt(1, 2) == 8);
  CHECK(pagesAt(1, 4) == 8);
  CHECK(pagesAt(0.99, 1) > 8);
  for (const int subdivision : {1, 2}) {
    settings.subdivision = subdivision;
    const Discretization discretization = discretize(scene, settings);
    const IdLayout layout = layOut(discretization, {.indexMaps = IndexMaps::Packed, .page = 64 * subdivision});
    CHECK(layout.pages.size() == 8);
    CHECK(makeDrawList(scene, discretization, layout).indexMaps.size() == 1);
    // The pages are nearly full: less than a quarter is spare, or has merged.
    CHECK(double(discretization.elements.size()) > 0.75 * 8 * 4096 * subdivision * subdivision);
  }
}

TEST_CASE("settingsForPages throws InputError for too many surfaces", "[grid size]") {
  std::vector<Surface> surfaces;
  for (int i = 0; i < 17; ++i) surfaces.push_back(flat("wall" + std::to_string(i), rectangle({0, 0}, {1, 1})));
  const Scene scene = sceneOf(std::move(surfaces));
  CHECK_THROWS_AS(settingsForPages(scene, 1, 4), raster::InputError);
  // Two pages of 4 x 4 hold 17 squares with one texel each. One page of 16 x 16 holds 25 squares of 3 x 3 but only 16
  // of 4 x 4. And 17 pages of 32 x 32 hold one square each, as large as the page.
  const auto texelSizeFor = [&](int pages, int side) { return *settingsForPages(scene, pages, side).texelSize; };
  CHECK(texelSizeFor(2, 4) == Approx(1).epsilon(0.002));
  CHECK(texelSizeFor(1, 16) == Approx(1.0 / 3).epsilon(0.002));
  CHECK(gridSizeOf(scene.surfaces[0], settingsForPages(scene, 17, 32)).columns == 32);
}

TEST_CASE("A strip that another front faces at less than its width has two texels across", "[grid size]") {
  // The floor is large, so that texels are wider than the strips.
  const auto sizesAt = [](double gap, double width) {
    const Scene scene = sceneOf({parallelogram("lower", {0, 0, 0}, {4, 0, 0}, {0, width, 0}),
                                 parallelogram("upper", {0, 0, gap}, {0, width, 0}, {4, 0, 0}),
                                 parallelogram("floor", {-2, -4, -5}, {8, 0, 0}, {0, 8, 0})});
    return gridSizesOf(scene, {});
  };
  const auto across = [](const GridSize& size) { return std::min(size.columns, size.rows); };
  for (const auto& [gap, expected] : {std::pair{0.05, 2}, {0.09, 2}, {0.11, 1}, {1.0, 1}, {-0.05, 1}}) {
    CAPTURE(gap);
    const std::vector<GridSize> sizes = sizesAt(gap, 0.1);
    for (const std::size_t strip : {0, 1}) CHECK(across(sizes[strip]) == expected);
    CHECK(std::max(sizes[0].columns, sizes[0].rows) >= 4);
  }
  CHECK(across(sizesAt(0.5, 2)[0]) > 2);  // not a strip
}
