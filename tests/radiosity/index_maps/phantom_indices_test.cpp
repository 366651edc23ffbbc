// Phantom indices: their number by cause, and rows that do not contain them.
#include "radiosity/index_maps/phantom_indices.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using raster::Blend;

namespace {

Phantoms phantomsOf(const Discretization& discretization, const IdSettings& ids) {
  return countPhantoms(discretization, layOut(discretization, ids));
}

IdSettings withPage(IndexMaps way, int page) { return {.indexMaps = way, .page = page}; }

Discretization paperRoom(const Scene& scene, int wall, int face) {
  DiscretizationSettings settings{.texels = wall, .surfaceTexels = {{"light", 1}}};
  for (const char* side : {"top", "bottom", "front", "right", "back", "left"})
    settings.surfaceTexels["box-" + std::string(side)] = face;
  return discretize(scene, settings);
}

}  // namespace

TEST_CASE("countPhantoms of the paper's room gives the numbers that follow from its sizes", "[phantoms]") {
  const Scene scene = loadScene(std::string(HEMITEX_DATA) + "/paper-room.obj");
  struct Expected {
    std::string name;
    IdSettings ids;
    std::uint64_t spare, gaps;
  };
  // Figure 2: six walls of 8 x 8, six faces of 3 x 3 and a light. 64 item IDs are 6 bits. A face leaves 64 - 9 of them,
  // up to the next offset or, with one map for all, inside the map. Pages of 8 x 8 hold a wall each, or four faces, or
  // two faces and the light. Pages of 16 x 16 hold four walls, or two walls, six faces and the light.
  //
  // The coarse level has 6 x 6, 2 x 2 and one texel: 241 elements. Walls leave 64 - 36, faces 64 - 4. Pages of 8 x 8
  // hold a wall each, and faces and light lie in the strips beside the walls.
  const std::vector<Expected> figure{{"shared", {}, 0, 6 * 55},
                                     {"one map for all", withPage(IndexMaps::Shared, 8), 6 * 55, 0},
                                     {"unaligned", {"r8g8b8a8", Blend::IntegerAdd, false}, 0, 0},
                                     {"pages of 8", withPage(IndexMaps::Packed, 8), 8 * 64 - 439, 0},
                                     {"pages of 16", withPage(IndexMaps::Packed, 16), 2 * 256 - 439, 0},
                                     {"unique", {.indexMaps = IndexMaps::Unique}, 0, 0}};
  const std::vector<Expected> coarse{{"shared", {}, 0, 6 * 28 + 6 * 60},
                                     {"one map for all", withPage(IndexMaps::Shared, 8), 6 * 28 + 6 * 60, 0},
                                     {"one larger map for all", withPage(IndexMaps::Shared, 16), 12 * 256 - 240, 0},
                                     {"unaligned", {"r8g8b8a8", Blend::IntegerAdd, false}, 0, 0},
                                     {"pages of 8", withPage(IndexMaps::Packed, 8), 6 * 64 - 241, 0},
                                     {"unique", {.indexMaps = IndexMaps::Unique}, 0, 0}};
  const auto check = [&](const Discretization& discretization, const std::vector<Expected>& cases) {
    for (const Expected& expected : cases) {
      INFO(expected.name);
      const Phantoms phantoms = phantomsOf(discretization, expected.ids);
      CHECK(phantoms.spareTexels == expected.spare);
      CHECK(phantoms.alignmentGaps == expected.gaps);
    }
  };
  check(paperRoom(scene, 8, 3), figure);
  check(paperRoom(scene, 6, 2), coarse);
}

TEST_CASE("countPhantoms plus used item IDs fill the range of item IDs", "[phantoms]") {
  // Each item ID below the last page's end is a texel with area, a texel without, or no texel.
  const Scene scene = sceneOf({bump(3), lShape(), ring(8), flat("wall", rectangle({0, 0}, {0.75, 0.75}))});
  const Discretization discretization = discretize(scene, {.texels = 12, .surfaceTexels = {{"ring", 17}}});
  std::uint64_t covered = 0;
  for (const Grid& grid : discretization.grids) covered += grid.elementOfTexel.size() - grid.phantoms;
  for (const IdSettings& ids :
       {IdSettings{}, IdSettings{"r8g8b8", Blend::IntegerAdd, false}, withPage(IndexMaps::Shared, 32),
        withPage(IndexMaps::Packed, 32), withPage(IndexMaps::Packed, 64)}) {
    const IdLayout layout = layOut(discretization, ids);
    const Page& last = layout.pages[layout.byOffset.back()];
    const std::uint64_t block =
        layout.aligned ? std::uint64_t{1} << layout.indexBits : std::uint64_t(last.columns) * std::uint64_t(last.rows);
    const Phantoms phantoms = countPhantoms(discretization, layout);
    CHECK(covered + phantoms.spareTexels + phantoms.alignmentGaps == last.offset + block);
  }
}

TEST_CASE(
    "compareIndexMaps finds no or few phantoms for unique maps and unaligned offsets, and fewer for packed pages than "
    "for shared maps",
    "[phantoms]") {
  for (const char* name : {"cornell-box", "curved-room", "paper-room", "pyramid-room", "gallery"}) {
    const Scene scene = loadScene(std::string(HEMITEX_DATA) + "/" + name + ".obj");
    const Discretization discretization = discretize(scene, {.texelSize = scene.extent / 40});
    const std::vector<IndexMapUse> uses = compareIndexMaps(discretization);
    REQUIRE(uses.size() == 5);
    const auto phantomsOf = [&](std::size_t way) {
      return uses[way].phantoms.spareTexels + uses[way].phantoms.alignmentGaps;
    };
    INFO(name);
    CHECK(phantomsOf(1) >= phantomsOf(0));  // one map for all has the most phantoms
    CHECK(phantomsOf(3) < phantomsOf(0));   // packing
    CHECK(uses[3].offsets < uses[0].offsets);
    CHECK(uses[2].phantoms.alignmentGaps == 0);  // integer addition
    CHECK(phantomsOf(2) == uses[0].phantoms.spareTexels);
    CHECK(phantomsOf(4) == 0);  // only elements
    CHECK(uses[4].ids == discretization.elements.size());
    for (std::size_t way = 0; way < 4; ++way) CHECK(uses[way].ids == uses[0].ids);
  }
}

TEST_CASE("ProjectedFormFactors store only visible elements, however many phantoms there are", "[phantoms]") {
  const Scene scene = loadScene(std::string(HEMITEX_DATA) + "/cornell-box.obj");
  const Discretization discretization = discretize(scene, {.texels = 9, .patch = 9});
  const std::vector<IdSettings> ways{{.indexMaps = IndexMaps::Unique},
                                     {"r8g8b8a8", Blend::IntegerAdd, false},
                                     {},
                                     withPage(IndexMaps::Shared, 16),
                                     withPage(IndexMaps::Shared, 256)};
  std::uint64_t before = 0;
  std::optional<FormFactorRow> expected;
  for (const IdSettings& ids : ways) {
    const IdLayout layout = layOut(discretization, ids);
    raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
    ProjectedFormFactors rows(scene, discretization, layout, renderer, {64});
    const FormFactorRow row = rows.ofPatch(discretization.patches.list[3]);
    const Phantoms phantoms = countPhantoms(discretization, layout);
    const std::uint64_t count = phantoms.spareTexels + phantoms.alignmentGaps;
    CHECK(count >= before);
    before = count;
    if (!expected) expected = row;
    CHECK(row.elements == expected->elements);
    CHECK(row.shares == expected->shares);
    CHECK(row.elements.capacity() < 2 * discretization.elements.size());
  }
  // 16 surfaces of 9 x 9 texels in maps of 256 x 256: eight hundred phantoms per element.
  CHECK(before > 800 * discretization.elements.size() * 9 / 10);
}
