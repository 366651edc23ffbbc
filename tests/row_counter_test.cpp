// Counting item buffers: windows of faces add up to their rows.
#include "radiosity/row_counter.h"

#include <catch2/catch.hpp>
#include <map>

#include "tests/box_scene.h"
#include "tests/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// The rectangle, its quarters cut somewhere off the middle.
std::vector<raster::Scissor> windows(const raster::Scissor& whole) {
  const int width = whole.width / 3, height = whole.height / 4;
  return {{whole.column, whole.row, width, height},
          {whole.column + width, whole.row, whole.width - width, height},
          {whole.column, whole.row + height, width, whole.height - height},
          {whole.column + width, whole.row + height, whole.width - width, whole.height - height}};
}

}  // namespace

TEST_CASE("the rows of windows drawn one by one add up to the row of the whole view", "[rows]") {
  tests::HemicubeWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 4);
  ProjectedRows rows = world.rows(32);
  const View view = rows.viewsOfPatch(5).front();
  const FormFactorRow whole = rows.ofView(view);
  RowCounter counter(world.discretization, world.layout);
  std::map<std::uint32_t, std::uint64_t> sums;
  std::uint64_t total = 0;
  for (std::size_t face = 0; face < view.faces.size(); ++face)
    for (const raster::Scissor& window : windows(view.faces[face].scissor)) {
      raster::Face part = view.faces[face];
      part.scissor = window;
      counter.add(*view.projection, face, window, world.renderer.render({&part, 1}, view.skipped).front());
      const FormFactorRow row = counter.take();
      for (std::size_t i = 0; i < row.elements.size(); ++i) {
        sums[row.elements[i]] += row.shares[i];
        total += row.shares[i];
      }
    }
  CHECK(total == wholeShare);
  REQUIRE(sums.size() == whole.elements.size());
  for (std::size_t i = 0; i < whole.elements.size(); ++i) REQUIRE(sums[whole.elements[i]] == whole.shares[i]);
}
