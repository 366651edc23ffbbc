// IdLookup maps all item IDs to slots as elementOf does.
#include "radiosity/form_factors/id_lookup.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "tests/support/box_scene.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using raster::Blend;
using raster::ItemId;

namespace {

/// Grids with holes and slivers, without either, and of one texel.
Scene mixedScene() {
  return sceneOf({bump(3), lShape(), ring(8), thinDiagonal(0.02), flat("wall", rectangle({0, 0}, {1, 1})),
                  flat("light", rectangle({0, 0}, {1, 1})), flat("lamp", rectangle({0, 0}, {1, 1})), star(7, 3)});
}

/// The number of item IDs whose slot differs from elementOf, looked up alone or after others. Tests the item IDs 0 to
/// 65535, some behind them, and the last ones.
int wrongSlots(const Discretization& discretization, const IdSettings& settings) {
  const IdLayout layout = layOut(discretization, settings);
  const IdLookup lookup(discretization, layout);
  std::vector<ItemId> ids;
  for (ItemId id = 0; id < 0x10000; ++id) ids.push_back(id);
  for (ItemId id = 0x10000; id < 0x800000; id += 97) ids.push_back(id);
  for (ItemId id = 0xffffff00; id != 0; ++id) ids.push_back(id);
  std::vector<std::uint32_t> slots(ids.size());
  lookup.find(ids, slots.data());
  int wrong = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t other = ids[i] == raster::backId(layout.format) ? lookup.back() : lookup.background();
    const std::uint32_t slot = elementOf(discretization, layout, ids[i]).value_or(other);
    std::uint32_t alone = 0;
    lookup.find({&ids[i], 1}, &alone);
    wrong += slots[i] != slot || alone != slot ? 1 : 0;
  }
  return wrong;
}

}  // namespace

TEST_CASE("IdLookup gives each item ID the slot of its element", "[rows]") {
  const Scene scene = mixedScene();
  const Discretization mixed =
      discretize(scene, {.texels = 12, .surfaceTexels = {{"bump", 33}, {"wall", 8}, {"light", 1}, {"lamp", 1}}});
  for (const char* format : {"r5g6b5", "r8g8b8a8", "r32ui"}) {
    INFO(format);
    CHECK(wrongSlots(mixed, {format}) == 0);
    CHECK(wrongSlots(mixed, {format, Blend::IntegerAdd, false}) == 0);
    CHECK(wrongSlots(mixed, {format, Blend::ClampedAdd, true, IndexMaps::Packed, 64}) == 0);
    CHECK(wrongSlots(mixed, {format, Blend::IntegerAdd, false, IndexMaps::Packed, 64}) == 0);
    CHECK(wrongSlots(mixed, {format, Blend::ClampedAdd, true, IndexMaps::Unique}) == 0);
  }
  CHECK(wrongSlots(mixed, {"r8g8b8a8", Blend::ClampedAdd, true, IndexMaps::Shared, 64}) == 0);
  // Seven million item IDs.
  CHECK(wrongSlots(mixed, {"r8g8b8a8", Blend::IntegerAdd, false, IndexMaps::Shared, 1024}) == 0);
}

TEST_CASE("IdLookup has slots for scenes without textures, and for more single item IDs than a page holds", "[rows]") {
  Scene scene = closedCube(glm::dvec3(0.5), glm::dvec3(1));
  CHECK(wrongSlots(discretize(scene, {.texels = 1}), {"r8g8b8a8"}) == 0);
  // Pages of 2 x 1 texels: k = 1, so that five single item IDs fill three blocks.
  Discretization one = discretize(scene, {.texels = 1});
  Discretization two = discretize(scene, {.texels = 2, .surfaceTexels = {{"left", 2}}});
  CHECK(wrongSlots(two, {"r8g8b8a8"}) == 0);
  const Discretization single = discretize(
      scene, {.texels = 2, .surfaceTexels = {{"left", 1}, {"right", 1}, {"floor", 1}, {"ceiling", 1}, {"front", 1}}});
  CHECK(layOut(single, {"r8g8b8a8"}).indexBits == 2);
  CHECK(wrongSlots(single, {"r8g8b8a8"}) == 0);
}

TEST_CASE("IdLookup needs no table for grids whose texels are all elements", "[rows]") {
  const Discretization plain = discretize(closedCube(glm::dvec3(0.5), glm::dvec3(1)), {.texels = 64});
  const IdLayout layout = layOut(plain);
  // Six blocks of 16 bytes, which a growing vector may double, and an empty table of single item IDs.
  CHECK(IdLookup(plain, layout).bytes() <= 2 * 6 * 16);
}

TEST_CASE("IdLookup of a page much larger than its grid has a table only of the grid's rows", "[rows]") {
  const Discretization plain = discretize(closedCube(glm::dvec3(0.5), glm::dvec3(1)), {.texels = 16});
  const IdLayout layout = layOut(plain, {.page = 4096});
  // Six tables of 16 rows; complete pages would take 400 MB.
  CHECK(IdLookup(plain, layout).bytes() <= 6 * 16 * 4096 * sizeof(std::uint32_t) + 2 * 6 * 16);
}
