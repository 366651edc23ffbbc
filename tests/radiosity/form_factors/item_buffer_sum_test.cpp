// ItemBufferSum compared with a sum pixel by pixel; windows add up to rows, and memory depends on pixels.
#include "radiosity/form_factors/item_buffer_sum.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "raster/base/parallel.h"
#include "tests/support/box_scene.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

std::vector<raster::ItemBuffer> drawn(tests::HemicubeWorld& world, const View& view, std::span<const Window> windows) {
  std::vector<raster::Face> faces;
  for (const Window& window : windows) {
    faces.push_back(view.faces[window.face]);
    faces.back().scissor = window.scissor;
  }
  return render(world.renderer, faces, view.skipped);
}

/// The sum pixel by pixel.
FormFactorRow countedSlowly(const tests::HemicubeWorld& world, const Projection& projection,
                            std::span<const Window> windows, std::span<const raster::ItemBuffer> buffers) {
  std::map<std::uint32_t, std::uint64_t> sums;
  FormFactorRow row;
  for (std::size_t w = 0; w < windows.size(); ++w)
    for (std::size_t pixel = 0; pixel < buffers[w].ids.size(); ++pixel) {
      const raster::Scissor& scissor = windows[w].scissor;
      const auto width = static_cast<std::size_t>(scissor.width);
      const std::uint64_t share = shareOf(projection, windows[w].face, scissor.column + static_cast<int>(pixel % width),
                                          scissor.row + static_cast<int>(pixel / width));
      const raster::ItemId id = buffers[w].ids[pixel];
      const auto element = elementOf(world.discretization, world.layout, id);
      if (element && share > 0) sums[*element] += share;
      if (!element) (id == raster::backId(world.layout.format) ? row.back : row.background) += share;
    }
  for (const auto& [element, share] : sums) {
    row.elements.push_back(element);
    row.shares.push_back(share);
  }
  return row;
}

bool areEqual(const FormFactorRow& a, const FormFactorRow& b) {
  return a.elements == b.elements && a.shares == b.shares && a.background == b.background && a.back == b.back;
}

/// Four parts of the rectangle, divided off the middle.
std::vector<raster::Scissor> quarters(const raster::Scissor& whole) {
  const int width = whole.width / 3, height = whole.height / 4;
  return {{whole.column, whole.row, width, height},
          {whole.column + width, whole.row, whole.width - width, height},
          {whole.column, whole.row + height, width, whole.height - height},
          {whole.column + width, whole.row + height, whole.width - width, whole.height - height}};
}

/// An open scene with holes, slivers and backs.
Scene openRoom() {
  Scene scene = tests::furnishedRoom();
  scene.surfaces.erase(scene.surfaces.begin() + 1);
  return tests::finish(std::move(scene));
}

}  // namespace

TEST_CASE("ItemBufferSum equals a sum pixel by pixel, for all windows and any number of threads", "[rows]") {
  tests::HemicubeWorld world(openRoom(), 20, 4);
  std::mt19937 random(3);
  ItemBufferSum counter(world.discretization, world.layout);
  for (const int resolution : {16, 64, 200})
    for (const ProjectionKind kind : {ProjectionKind::Hemicube, ProjectionKind::CubicTetrahedron}) {
      ProjectedFormFactors rows(world.scene, world.discretization, world.layout, world.renderer,
                                {.resolution = resolution, .orientation = Orientation::Turned, .projection = kind});
      for (int i = 0; i < 3; ++i) {
        const auto patch = static_cast<std::uint32_t>(random() % world.discretization.patches.list.size());
        const View view = rows.viewsOfPatch(world.discretization.patches.list[patch]).front();
        std::vector<Window> windows = wholeFaces(*view.projection);
        for (int part = 0; part < 4; ++part) windows.push_back({0, quarters(windows[0].scissor)[std::size_t(part)]});
        const std::vector<raster::ItemBuffer> buffers = drawn(world, view, windows);
        const FormFactorRow expected = countedSlowly(world, *view.projection, windows, buffers);
        for (const int threads : {1, 2, 7}) {
          const raster::ThreadLimit limit(threads);
          CHECK(areEqual(counter.rowOf(*view.projection, windows, buffers), expected));
        }
      }
    }
}

TEST_CASE("ItemBufferSum of windows drawn one by one adds up to the row of the whole view", "[rows]") {
  tests::HemicubeWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 4);
  ProjectedFormFactors rows = world.rows(32);
  const View view = rows.viewsOfPatch(world.discretization.patches.list[5]).front();
  const FormFactorRow whole = rows.ofView(view);
  ItemBufferSum counter(world.discretization, world.layout);
  std::map<std::uint32_t, std::uint64_t> sums;
  std::uint64_t total = 0;
  for (std::size_t face = 0; face < view.faces.size(); ++face)
    for (const raster::Scissor& scissor : quarters(view.faces[face].scissor)) {
      const Window window{face, scissor};
      const FormFactorRow row = counter.rowOf(*view.projection, {&window, 1}, drawn(world, view, {&window, 1}));
      for (std::size_t i = 0; i < row.elements.size(); ++i) {
        sums[row.elements[i]] += row.shares[i];
        total += row.shares[i];
      }
    }
  CHECK(total == wholeShare);
  REQUIRE(sums.size() == whole.elements.size());
  for (std::size_t i = 0; i < whole.elements.size(); ++i) REQUIRE(sums[whole.elements[i]] == whole.shares[i]);
}

TEST_CASE("ItemBufferSum takes memory by the number of pixels, not of elements", "[rows]") {
  // Each of 16 x 16 x 3 pixels shows one element, in a block of 64 shares with a bit each; a growing vector may double
  // that. One number per 64 elements and one bit per 4096 are always allocated, and so are the scene's six pages.
  tests::HemicubeWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 256, 64);
  ProjectedFormFactors rows = world.rows(16);
  ItemBufferSum counter(world.discretization, world.layout);
  const std::size_t elements = world.discretization.elements.size();
  REQUIRE(elements == 6 * 256 * 256);
  const std::size_t before = counter.bytes();
  CHECK(before <= elements / 64 * 4 + elements / 4096 * 8 + 500);
  const View view = rows.viewsOfPatch(world.discretization.patches.list[40]).front();
  const std::vector<Window> windows = wholeFaces(*view.projection);
  const raster::ThreadLimit one(1);
  CHECK(counter.rowOf(*view.projection, windows, drawn(world, view, windows)).elements.size() <= 768);
  CHECK(counter.bytes() - before <= 2 * 768 * 65 * 8);
}
