// The item IDs of elements, and the draws that produce them.
#include "radiosity/index_maps/id_layout.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/phantom_indices.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using raster::Blend;
using raster::ItemId;

namespace {

struct Size {
  int columns, rows;
};

/// Grids of these sizes, completely covered; layOut uses nothing else.
Discretization gridsOf(const std::vector<Size>& sizes) {
  Discretization discretization;
  for (const Size& size : sizes) {
    Grid grid;
    grid.columns = size.columns;
    grid.rows = size.rows;
    discretization.grids.push_back(grid);
  }
  return discretization;
}

std::vector<Size> times(std::size_t count, Size size) { return std::vector<Size>(count, size); }

std::vector<Size> joined(std::vector<Size> a, const std::vector<Size>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string messageOf(const std::vector<Size>& sizes, std::string_view format, Blend blend, bool aligned) {
  try {
    layOut(gridsOf(sizes), {std::string(format), blend, aligned});
    return {};
  } catch (const raster::InputError& error) {
    return error.what();
  }
}

bool fits(const std::vector<Size>& sizes, std::string_view format, bool aligned) {
  return messageOf(sizes, format, Blend::IntegerAdd, aligned).empty();
}

bool mentions(const std::string& message, const std::string& text) { return message.find(text) != std::string::npos; }

std::vector<ItemId> offsetsOf(const IdLayout& layout) {
  std::vector<ItemId> offsets;
  for (const Page& page : layout.pages) offsets.push_back(page.offset);
  return offsets;
}

/// Whether each texel's item ID is blended to offset + texel, is not reserved, and decodes to its texel. Also tests
/// that no other item ID of the format decodes.
bool isOneToOne(const Discretization& discretization, const IdLayout& layout) {
  const ItemId background = raster::backgroundId(layout.format);
  std::vector<bool> taken(std::size_t{background} + 1);
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    const Grid& grid = discretization.grids[s];
    for (std::uint32_t texel = 0; texel < std::uint32_t(grid.columns * grid.rows); ++texel) {
      const ItemId id = raster::blend(layout.format, layout.blend, layout.pages[s].offset, texel);
      const auto decoded = pageIndexOf(layout, id);
      if (id != layout.pages[s].offset + texel || id >= background - 1 || taken[id]) return false;
      if (!decoded || decoded->page != s || decoded->index != texel) return false;
      taken[id] = true;
    }
  }
  for (std::uint64_t id = 0; id <= background; ++id)
    if (!taken[id] && pageIndexOf(layout, ItemId(id))) return false;
  return true;
}

}  // namespace

TEST_CASE("layOut gives each element of a full 24-bit item ID with 12 index bits its own item ID", "[layout]") {
  // 4096 surfaces of 64 x 64. The last surface's last two item IDs are reserved, so that it is 63 x 64 here.
  const Discretization discretization = gridsOf(joined(times(4095, {64, 64}), {{63, 64}}));
  const IdLayout layout = layOut(discretization, {"r8g8b8", Blend::ClampedAdd, true});
  CHECK(layout.indexBits == 12);
  CHECK(isOneToOne(discretization, layout));
}

TEST_CASE("layOut is one to one for mixed sizes, aligned or not, in all narrow formats", "[layout]") {
  const std::vector<Size> mixed{{1, 1}, {8, 8}, {3, 3}, {1, 1}, {1, 5}, {7, 9}, {1, 1}, {2, 32}, {8, 8}, {1, 1}};
  for (const char* format : {"r5g6b5", "r8g8b8"}) {
    const Discretization discretization = gridsOf(mixed);
    CHECK(isOneToOne(discretization, layOut(discretization, {format, Blend::ClampedAdd, true})));
    CHECK(isOneToOne(discretization, layOut(discretization, {format, Blend::IntegerAdd, true})));
    CHECK(isOneToOne(discretization, layOut(discretization, {format, Blend::IntegerAdd, false})));
  }
}

TEST_CASE("layOut gives textured surfaces aligned blocks in order, followed by single item IDs", "[layout]") {
  // 65 texels need 7 bits.
  const IdLayout layout =
      layOut(gridsOf({{1, 1}, {8, 8}, {1, 1}, {5, 13}, {3, 3}}), {"r8g8b8", Blend::ClampedAdd, true});
  CHECK(layout.indexBits == 7);
  CHECK(offsetsOf(layout) == std::vector<ItemId>{384, 0, 385, 128, 256});
  CHECK(layout.byOffset == std::vector<std::uint32_t>{1, 3, 4, 0, 2});
}

TEST_CASE("layOut without alignment leaves no gap between offsets", "[layout]") {
  const IdLayout layout =
      layOut(gridsOf({{1, 1}, {8, 8}, {1, 1}, {5, 13}, {3, 3}}), {"r8g8b8", Blend::IntegerAdd, false});
  CHECK(offsetsOf(layout) == std::vector<ItemId>{0, 1, 65, 66, 131});
  CHECK(layout.byOffset == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
}

TEST_CASE("layOut uses all item IDs of a format less two, and not one more", "[layout]") {
  // r5g6b5: 65536 item IDs, of which 65534 are usable. With 8 x 8 texels, 1023 blocks and 62 single item IDs fill it.
  CHECK(fits(times(65534, {1, 1}), "r5g6b5", true));
  CHECK_FALSE(fits(times(65535, {1, 1}), "r5g6b5", true));
  CHECK(fits(joined(times(1023, {8, 8}), times(62, {1, 1})), "r5g6b5", true));
  CHECK_FALSE(fits(joined(times(1023, {8, 8}), times(63, {1, 1})), "r5g6b5", true));
  CHECK(fits(joined(times(1023, {8, 8}), {{2, 31}}), "r5g6b5", true));
  CHECK_FALSE(fits(joined(times(1023, {8, 8}), {{7, 9}}), "r5g6b5", true));
  CHECK_FALSE(fits(times(1024, {8, 8}), "r5g6b5", true));
  CHECK(fits(joined(times(1023, {8, 8}), {{2, 31}}), "r5g6b5", false));
  CHECK_FALSE(fits(joined(times(1023, {8, 8}), {{7, 9}}), "r5g6b5", false));
  // Without alignment 9 texels take 9 item IDs instead of 16.
  CHECK(fits(times(7281, {3, 3}), "r5g6b5", false));
  CHECK_FALSE(fits(times(7282, {3, 3}), "r5g6b5", false));
  CHECK_FALSE(fits(times(4097, {3, 3}), "r5g6b5", true));
}

TEST_CASE("layOut throws InputError with the item IDs needed, and the format and the texels that would fit",
          "[layout]") {
  // 1024 * 64 = 65536 item IDs for 65534. With 7 x 7 texels a block still has 64 item IDs, but the end of the last may
  // be missing.
  const std::string tooMany = messageOf(times(1024, {8, 8}), "r5g6b5", Blend::ClampedAdd, true);
  CHECK(mentions(tooMany, "needs 65536 item IDs"));
  CHECK(mentions(tooMany, "65534"));
  CHECK(mentions(tooMany, "r8g8b8"));
  CHECK_FALSE(mentions(tooMany, "r8g8b8a8"));
  CHECK(mentions(tooMany, "7 x 7 texels"));
  CHECK(fits(times(1024, {7, 7}), "r5g6b5", true));
  // 300 surfaces of 4096 x 4096 fit no format: 2^32 / 300 > 2^23, and 2^23 holds 2896 x 2896.
  const std::string noFormat = messageOf(times(300, {4096, 4096}), "r32ui", Blend::IntegerAdd, true);
  CHECK_FALSE(mentions(noFormat, "format r"));
  CHECK(mentions(noFormat, "2896 x 2896 texels"));
  CHECK(fits(times(300, {2896, 2896}), "r32ui", true));
  CHECK_FALSE(fits(times(300, {2897, 2897}), "r32ui", true));
  // More surfaces than item IDs: no number of texels fits.
  const std::string surfaces = messageOf(times(65535, {2, 2}), "r5g6b5", Blend::ClampedAdd, true);
  CHECK(mentions(surfaces, "use the format r8g8b8"));
  CHECK_FALSE(mentions(surfaces, "texels"));
  CHECK(mentions(messageOf({{1, 1}}, "r9g9b9e5", Blend::ClampedAdd, true), "r10g10b10a2"));
}

TEST_CASE("layOut fits a million surfaces of 64 x 64 texels into 32 bits", "[layout]") {
  const Discretization discretization = gridsOf(times(1000000, {64, 64}));
  const IdLayout layout = layOut(discretization);
  for (const std::uint32_t s : {0u, 1u, 123456u, 999999u}) {
    const auto decoded = pageIndexOf(layout, layout.pages[s].offset + 4095);
    REQUIRE(decoded);
    CHECK(decoded->page == s);
    CHECK(decoded->index == 4095);
  }
  CHECK_FALSE(pageIndexOf(layout, 0xfffffffe));
  CHECK_FALSE(pageIndexOf(layout, 0xffffffff));
  CHECK_FALSE(pageIndexOf(layout, 1000000u << 12));
}

TEST_CASE("layOut and pageIndexOf handle the last item IDs of 32 bits", "[layout]") {
  // 256 blocks of 2^24; the last one ends right before the reserved item IDs.
  const Discretization discretization = gridsOf(joined(times(255, {4096, 4096}), {{4095, 4096}}));
  const IdLayout layout = layOut(discretization, {"r32ui", Blend::ClampedAdd, true});
  const auto last = pageIndexOf(layout, 0xff000000u + 4095 * 4096 - 1);
  REQUIRE(last);
  CHECK(last->page == 255);
  CHECK(last->index == 4095 * 4096 - 1);
  CHECK_FALSE(pageIndexOf(layout, 0xff000000u + 4095 * 4096));
}

TEST_CASE("layOut without alignment reaches no reserved item ID, clamped or not", "[layout]") {
  // Clamping a channel lowers the sum, because it drops the carry. The last map ends right below the reserved item IDs.
  // So each clamped sum stays below them, wherever the map begins.
  for (const Size& map : {Size{2, 1}, {5, 7}, {16, 16}, {63, 65}, {255, 256}}) {
    const auto before = std::size_t(65534 - map.columns * map.rows);
    const Discretization discretization = gridsOf(joined(times(before, {1, 1}), {map}));
    const IdLayout layout = layOut(discretization, {"r5g6b5", Blend::ClampedAdd, false});
    for (ItemId texel = 0; texel < ItemId(map.columns * map.rows); ++texel)
      REQUIRE(raster::blend(layout.format, layout.blend, layout.pages.back().offset, texel) < 65534);
  }
}

TEST_CASE("countPhantoms counts indices that no texel produces, by cause", "[layout]") {
  // A chart of 3/4 x 3/4 leaves 64 - 36 texels of an 8 x 8 map without area. A 3 x 3 map leaves 64 - 9 up to the next
  // aligned offset. The surface of one texel leaves none.
  Scene scene = sceneOf({flat("wall", rectangle({0, 0}, {0.75, 0.75})), flat("box", rectangle({0, 0}, {1, 1})),
                         flat("light", rectangle({0, 0}, {0.5, 0.5}))});
  const Discretization discretization = discretize(scene, {.texels = 8, .surfaceTexels = {{"box", 3}, {"light", 1}}});
  const Phantoms aligned = countPhantoms(discretization, layOut(discretization, {"r8g8b8", Blend::ClampedAdd, true}));
  CHECK(aligned.spareTexels == 28);
  CHECK(aligned.alignmentGaps == 55);
  const Phantoms packed = countPhantoms(discretization, layOut(discretization, {"r8g8b8", Blend::IntegerAdd, false}));
  CHECK(packed.spareTexels == 28);
  CHECK(packed.alignmentGaps == 0);
}

TEST_CASE("makeDrawList numbers the scene's triangles and shares index maps of one size", "[layout]") {
  Scene scene = sceneOf({bump(3), flat("a", rectangle({0, 0}, {1, 1})), flat("b", rectangle({0, 0}, {1, 1})),
                         flat("light", rectangle({0, 0}, {1, 1}))});
  const Discretization discretization = discretize(scene, {.texels = 4, .surfaceTexels = {{"b", 3}, {"light", 1}}});
  const IdLayout layout = layOut(discretization, {"r8g8b8", Blend::ClampedAdd, true});
  const raster::DrawList list = makeDrawList(scene, discretization, layout);
  CHECK_NOTHROW(raster::validate(list));
  REQUIRE(list.draws.size() == 4);
  CHECK(list.indexMaps.size() == 2);
  CHECK(list.draws[0].indexMap == list.draws[1].indexMap);
  CHECK_FALSE(list.draws[3].indexMap);
  std::size_t t = 0;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    CHECK(list.draws[s].first == 3 * t);
    CHECK(list.draws[s].count == 3 * scene.surfaces[s].triangles.size());
    CHECK(list.draws[s].offset == layout.pages[s].offset);
    CHECK(list.draws[s].back == raster::backId(layout.format));
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = list.indices[3 * t + k];
        CHECK(list.positions[vertex] == glm::vec3(triangle.position[k] - scene.origin));
        CHECK(list.texcoords[vertex] == glm::vec2(triangle.chart[k]));
      }
      ++t;
    }
  }
  const raster::IndexMap& map = list.indexMaps[std::size_t(*list.draws[2].indexMap)];
  CHECK(map.ids == std::vector<ItemId>{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("makeDrawList draws a wall that fills the view as its texels, each over the same number of pixels",
          "[layout]") {
  // The wall spans the frustum of a 90-degree view at distance 1; 4 x 4 texels over 32 x 32 pixels are 64 pixels each.
  const Scene scene = sceneOf({quad("wall", {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}})});
  const Discretization discretization = discretize(scene, {.texels = 4});
  const IdLayout layout = layOut(discretization, {"r5g6b5", Blend::ClampedAdd, true});
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  const glm::vec3 eye = glm::dvec3(0, 0, 0) - scene.origin;
  const raster::Face face{eye, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.1f, 32, {0, 0, 32, 32}};
  const raster::ItemBuffer buffer = render(renderer, {&face, 1}, {}).front();
  for (int row = 0; row < 32; ++row)
    for (int column = 0; column < 32; ++column) {
      const auto seen = pageIndexOf(layout, buffer.ids[std::size_t(row * 32 + column)]);
      REQUIRE(seen);
      REQUIRE(seen->index == std::uint32_t(row / 8 * 4 + column / 8));
    }
}
