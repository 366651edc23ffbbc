// Levels of detail: discretizations share their geometry, and coarser maps show the blocks of finer ones. Rows with
// coarser maps keep the light of each block and have smaller errors.
#include "radiosity/form_factors/level_of_detail.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "tests/support/box_scene.h"
#include "tests/support/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

using World = tests::HemicubeWorld;

template <typename Value>
bool sameBytes(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

std::uint64_t sum(const FormFactorRow& row) {
  return std::accumulate(row.shares.begin(), row.shares.end(), row.background + row.back);
}

ViewSettings viewOf(int resolution, double pixelsPerElement) {
  return {resolution, Orientation::Turned, ProjectionKind::Hemicube, pixelsPerElement};
}

/// The sum of all errors of a row.
double distance(const FormFactorRow& a, const FormFactorRow& b) {
  std::map<std::uint32_t, double> difference;
  for (std::size_t i = 0; i < a.elements.size(); ++i) difference[a.elements[i]] += formFactor(a.shares[i]);
  for (std::size_t i = 0; i < b.elements.size(); ++i) difference[b.elements[i]] -= formFactor(b.shares[i]);
  double sum = 0;
  for (const auto& [element, value] : difference) sum += std::abs(value);
  return sum;
}

/// A surface of 4 x 4 texels, and a row that sees some of them.
struct Board {
  Scene scene;
  Discretization discretization;

  Board() {
    scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(1)));
    scene.surfaces = {tests::quad("board", {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}})};
    scene = tests::finish(scene);
    discretization = discretize(scene, {.texels = 4});
  }
};

}  // namespace

TEST_CASE("makeDrawList of two discretizations of a scene differs only in offsets and index maps", "[levels]") {
  const Scene scene = loadScene(HEMITEX_DATA "/curved-room.obj");
  const auto listOf = [&scene](int texels) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    return makeDrawList(scene, discretization, layOut(discretization));
  };
  const raster::DrawList coarse = listOf(4), fine = listOf(64);
  CHECK(sameBytes(coarse.positions, fine.positions));
  CHECK(sameBytes(coarse.texcoords, fine.texcoords));
  CHECK(sameBytes(coarse.indices, fine.indices));
  REQUIRE(coarse.draws.size() == fine.draws.size());
  for (std::size_t d = 0; d < coarse.draws.size(); ++d) {
    CHECK(coarse.draws[d].first == fine.draws[d].first);
    CHECK(coarse.draws[d].count == fine.draws[d].count);
    CHECK(coarse.draws[d].back == fine.draws[d].back);
  }
  CHECK(coarse.draws.back().offset != fine.draws.back().offset);
  CHECK(coarse.indexMaps.front().width != fine.indexMaps.front().width);
}

TEST_CASE("a coarser index map of makeDrawList shows the blocks of a finer one, pixel by pixel", "[levels]") {
  const Scene scene = loadScene(HEMITEX_DATA "/curved-room.obj");
  constexpr int fineTexels = 32;
  World fine(scene, fineTexels, 8);
  const View view = fine.rows(64).viewsOfPatch(fine.discretization.patches.list[100]).front();
  const std::vector<raster::ItemBuffer> fineBuffers = render(fine.renderer, view.faces, view.skipped);
  for (const int level : {1, 3, 5}) {
    const int texels = fineTexels >> level;
    World coarse(scene, texels, 1);
    const std::vector<raster::ItemBuffer> buffers = render(coarse.renderer, view.faces, view.skipped);
    int compared = 0;
    for (std::size_t face = 0; face < buffers.size(); ++face)
      for (std::size_t i = 0; i < buffers[face].ids.size(); ++i) {
        const auto small = pageIndexOf(fine.layout, fineBuffers[face].ids[i]);
        const auto large = pageIndexOf(coarse.layout, buffers[face].ids[i]);
        REQUIRE(small.has_value() == large.has_value());
        if (!small) continue;
        REQUIRE(small->page == large->page);
        const int row = static_cast<int>(small->index) / fineTexels,
                  column = static_cast<int>(small->index) % fineTexels;
        REQUIRE(static_cast<int>(large->index) == (row >> level) * texels + (column >> level));
        ++compared;
      }
    CHECK(compared > 10000);
  }
}

TEST_CASE("withCoarserMaps keeps the index map of a surface with enough pixels", "[levels]") {
  const Board board;
  const FormFactorRow row{{1, 6, 12}, {100, 200, 300}, 7, 8};
  const FormFactorRow same = withCoarserMaps(board.discretization, row, std::vector<std::uint32_t>{4, 1, 1}, 2);
  CHECK(same.elements == row.elements);
  CHECK(same.shares == row.shares);
  CHECK(same.background == 7);
  CHECK(same.back == 8);
}

TEST_CASE("withCoarserMaps gives the light of a block to its elements by area, to the last unit", "[levels]") {
  // Elements 1 and 4 lie in the block of 2 x 2 texels at the chart's origin, 15 in the opposite one. The two visible
  // blocks have five pixels, enough for two and a half each, but not for three elements.
  const Board board;
  const FormFactorRow row{{1, 4, 15}, {100, 203, 40}, 0, 0};
  const std::vector<std::uint32_t> pixels{2, 2, 1};
  const FormFactorRow blocks = withCoarserMaps(board.discretization, row, pixels, 2.5);
  CHECK(blocks.elements == std::vector<std::uint32_t>{0, 1, 4, 5, 10, 11, 14, 15});
  // Quarters of 303; the running sums are rounded down: 75, 151, 227, 303.
  CHECK(blocks.shares == std::vector<std::uint64_t>{75, 76, 76, 76, 10, 10, 10, 10});
  // With a limit above 2.5 pixels the whole surface is one block.
  const FormFactorRow whole = withCoarserMaps(board.discretization, row, pixels, 2.6);
  CHECK(whole.elements.size() == 16);
  CHECK(sum(whole) == sum(row));
  CHECK(*std::max_element(whole.shares.begin(), whole.shares.end()) -
            *std::min_element(whole.shares.begin(), whole.shares.end()) <=
        1);
}

TEST_CASE("withCoarserMaps gives rows that sum to exactly one, with smaller errors where pixels are few", "[levels]") {
  // A closed cube with 32 x 32 elements per wall in hemicubes of 32 x 32 pixels, which have three pixels per five
  // elements. The reference is a hemicube of 1024. The error of each row falls.
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 32, 8);
  const auto rowsAt = [&world](const ViewSettings& settings) {
    return ProjectedFormFactors(world.scene, world.discretization, world.layout, world.renderer, settings);
  };
  ProjectedFormFactors truth = rowsAt(viewOf(1024, 0)), plain = rowsAt(viewOf(32, 0)),
                       coarser = rowsAt(viewOf(32, suggestedPixelsPerElement));
  double plainError = 0, coarserError = 0;
  for (const std::uint32_t patch : {3U, 20U, 37U, 54U, 90U}) {
    const FormFactorRow exact = truth.ofPatch(world.discretization.patches.list[patch]),
                        row = coarser.ofPatch(world.discretization.patches.list[patch]);
    CHECK(sum(row) == wholeShare);
    CHECK(std::is_sorted(row.elements.begin(), row.elements.end()));
    CHECK(std::find(row.shares.begin(), row.shares.end(), 0) == row.shares.end());
    const double before = distance(plain.ofPatch(world.discretization.patches.list[patch]), exact),
                 after = distance(row, exact);
    CHECK(after < before);
    plainError += before;
    coarserError += after;
  }
  CHECK(coarserError < plainError / 2);
}
