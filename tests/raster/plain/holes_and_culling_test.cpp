// Version 2 of the rules: index maps with holes and draws that cull, in PlainRenderer and SoftwareRenderer.
#include <algorithm>
#include <catch2/catch.hpp>

#include "raster/plain/plain_renderer.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;
using raster::Cull;
using raster::DrawList;
using raster::Face;
using raster::holeTexel;
using raster::ItemId;

namespace {

constexpr ItemId background = 0xffffffff;

/// The item IDs of a face, which both renderers draw alike.
std::vector<ItemId> idsOf(const DrawList& list, const Face& face) {
  const std::vector<ItemId> ids = drawOne(list, face).ids;
  CHECK(render(raster::PlainRenderer(list), {&face, 1}).front().ids == ids);
  return ids;
}

/// Whether the pixels left and right of the middle of a face show two item IDs.
bool show(const std::vector<ItemId>& ids, int resolution, ItemId left, ItemId right) {
  for (std::size_t p = 0; p < ids.size(); ++p)
    if (ids[p] != (2 * static_cast<int>(p) % (2 * resolution) < resolution ? left : right)) return false;
  return true;
}

/// A list with index maps of two texels: 5 and a hole, a hole and 6.
reference::Picture halfOpenMaps() {
  reference::Picture picture(16);
  picture.indexMaps = {{2, 1, {5, holeTexel}}, {2, 1, {holeTexel, 6}}};
  return picture;
}

/// Adds a wall that fills the view. A wall that is turned shows its back.
void addWall(reference::Picture& picture, ItemId offset, std::optional<int> map, double w, Cull cull = Cull::None,
             bool isTurned = false, std::optional<ItemId> back = {}) {
  addDraw(picture, offset, back, map);
  picture.draws.back().cull = cull;
  picture.addBlock(picture.whole(), w);
  if (isTurned) reference::turnLastDraw(picture);
}

/// Makes a third of the texels holes and lets the draws cull in turn.
DrawList withHolesAndCulling(DrawList list) {
  std::mt19937 random(4);
  for (raster::IndexMap& map : list.indexMaps)
    for (ItemId& texel : map.ids)
      if (random() % 3 == 0) texel = holeTexel;
  for (std::size_t d = 0; d < list.draws.size(); ++d) list.draws[d].cull = static_cast<Cull>(d / 2 % 3);
  return list;
}

std::uint64_t differences(const std::vector<ItemId>& a, const std::vector<ItemId>& b) {
  std::uint64_t count = 0;
  for (std::size_t p = 0; p < a.size(); ++p) count += a[p] != b[p];
  return count;
}

}  // namespace

TEST_CASE("SoftwareRenderer and PlainRenderer draw crossing and small triangles with holes and culling alike",
          "[holes]") {
  for (const DrawList& whole : {crossingTriangles(), smallTriangles(300)}) {
    DrawList list = withHolesAndCulling(whole), culled = list;
    culled.indexMaps = whole.indexMaps;
    std::uint64_t byHoles = 0, byCulling = 0;
    for (const Face& face : facesAndParts()) {
      const std::vector<ItemId> ids = idsOf(list, face);
      byHoles += differences(ids, idsOf(culled, face));
      byCulling += differences(idsOf(culled, face), drawOne(whole, face).ids);
    }
    CHECK(byHoles > 500);
    CHECK(byCulling > 500);
  }
}

TEST_CASE("SoftwareRenderer draws what stands behind the holes of a near wall, in any order of draws", "[holes]") {
  for (const bool isLast : {false, true}) {
    DrawList list = withHolesAndCulling(crossingTriangles());
    for (glm::vec3& position : list.positions) position.z += 3;
    const auto addNear = [&] {
      list.indexMaps.push_back({64, 64, std::vector<ItemId>(64 * 64, holeTexel)});
      for (std::size_t texel = 0; texel < 64 * 64; texel += 5) list.indexMaps.back().ids[texel] = 7;
      addDraw(list, 0x10000, {}, 1);
      reference::addQuad(list, {glm::vec3{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});
    };
    addNear();
    if (!isLast) std::rotate(list.draws.begin(), list.draws.end() - 1, list.draws.end());
    const std::vector<ItemId> ids = idsOf(list, frontFace(128));
    CHECK(std::count(ids.begin(), ids.end(), 0x10007U) == 4 * (64 * 64 / 5 + 1));
    CHECK(std::count(ids.begin(), ids.end(), background) < 128 * 128 / 2);
  }
}

TEST_CASE("A hole shows what is behind it, in both orders of draws", "[holes]") {
  for (const bool isFirst : {true, false}) {
    reference::Picture picture = halfOpenMaps();
    if (isFirst) addWall(picture, 0x100, 0, 1);
    addWall(picture, 0x200, {}, 2);
    if (!isFirst) addWall(picture, 0x100, 0, 1);
    CHECK(show(idsOf(picture, frontFace(16)), 16, 0x105, 0x200));
  }
  reference::Picture alone = halfOpenMaps();
  addWall(alone, 0x100, 1, 1);
  CHECK(show(idsOf(alone, frontFace(16)), 16, background, 0x106));
}

TEST_CASE("A hole leaves a pixel to a later triangle at the same depth, and not to one behind it", "[holes]") {
  for (const int first : {0, 1}) {
    reference::Picture picture = halfOpenMaps();
    addWall(picture, 0x100, first, 1);
    addWall(picture, 0x200, {}, 1);
    addWall(picture, 0x300, 1 - first, 1);
    CHECK(show(idsOf(picture, frontFace(16)), 16, first == 0 ? 0x105 : 0x200, first == 0 ? 0x200 : 0x106));
  }
}

TEST_CASE("A hole is open from both sides, also where the draw has a back item ID", "[holes]") {
  for (const std::optional<ItemId>& back : {std::optional<ItemId>(), std::optional<ItemId>(0x999)}) {
    reference::Picture picture = halfOpenMaps();
    addWall(picture, 0x100, 0, 1, Cull::None, true, back);
    addWall(picture, 0x200, {}, 2);
    CHECK(show(idsOf(picture, frontFace(16)), 16, back.value_or(0x105), 0x200));
  }
}

TEST_CASE("A hole is a hole for every blend and format", "[holes]") {
  for (const raster::Blend blend : {raster::Blend::ClampedAdd, raster::Blend::IntegerAdd, raster::Blend::Replace})
    for (const raster::IdFormat& format :
         {raster::IdFormat{{32}}, raster::IdFormat{{8, 8, 8, 8}}, raster::IdFormat{{5, 6, 5}}}) {
      reference::Picture picture = halfOpenMaps();
      picture.format = format;
      picture.blend = blend;
      addWall(picture, 0x100, 0, 1);
      const ItemId shown = blend == raster::Blend::Replace ? 5 : 0x105;
      CHECK(show(idsOf(picture, frontFace(16)), 16, shown, raster::backgroundId(format)));
    }
}

TEST_CASE("Two coincident sides that cull backs show the one that faces the eye, in both orders", "[culling]") {
  for (const bool isTurnedFirst : {false, true})
    for (const bool fromBehind : {false, true}) {
      reference::Picture picture(16);
      addWall(picture, 1, {}, 1, Cull::Back, isTurnedFirst);
      addWall(picture, 2, {}, 1, Cull::Back, !isTurnedFirst);
      Face face = frontFace(16);
      if (fromBehind) face = {{0, 0, 2}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.01F, 16, {0, 0, 16, 16}};
      INFO("turned first: " << isTurnedFirst << ", from behind: " << fromBehind);
      const ItemId expected = isTurnedFirst == fromBehind ? 1 : 2;
      CHECK(show(idsOf(picture, face), 16, expected, expected));
      face.x = -face.x;  // mirrors the picture, not the sides
      CHECK(show(idsOf(picture, face), 16, expected, expected));
    }
}

TEST_CASE("Culled triangles do not exist: what is behind them shows, also without a back item ID", "[culling]") {
  for (const bool isTurned : {false, true})
    for (const Cull cull : {Cull::None, Cull::Front, Cull::Back})
      for (const std::optional<ItemId>& back : {std::optional<ItemId>(), std::optional<ItemId>(0x999)}) {
        reference::Picture picture(16);
        addWall(picture, 1, {}, 1, cull, isTurned, back);
        addWall(picture, 2, {}, 2);
        const bool isCulled = cull == (isTurned ? Cull::Back : Cull::Front);
        const ItemId near = isTurned ? back.value_or(1) : 1;
        CHECK(show(idsOf(picture, frontFace(16)), 16, isCulled ? 2 : near, isCulled ? 2 : near));
      }
}
