// The three ways to use index maps: shared, packed and unique maps give the same elements with different item IDs.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/projection_kinds.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;
using raster::Blend;
using raster::ItemId;

namespace {

struct Way {
  std::string name;
  IdSettings ids;
};

std::vector<Way> allWays() {
  const std::string r8 = "r8g8b8a8";
  return {{"shared", {r8}},
          {"shared, unaligned", {r8, Blend::IntegerAdd, false}},
          {"one map for all", {r8, Blend::ClampedAdd, true, IndexMaps::Shared, 64}},
          {"packed", {r8, Blend::ClampedAdd, true, IndexMaps::Packed, 64}},
          {"packed, unaligned", {r8, Blend::IntegerAdd, false, IndexMaps::Packed, 64}},
          {"unique", {r8, Blend::ClampedAdd, true, IndexMaps::Unique}}};
}

/// Grids from 1 to 33 texels along a side, holes, slivers and curves.
Scene mixedScene() {
  return sceneOf({bump(3), lShape(), ring(8), thinDiagonal(0.02), flat("wall", rectangle({0, 0}, {0.75, 0.75})),
                  flat("light", rectangle({0, 0}, {1, 1})), star(7, 3)});
}

Discretization mixedGrids(const Scene& scene) {
  return discretize(scene, {.texels = 12, .surfaceTexels = {{"bump", 33}, {"ring", 17}, {"light", 1}, {"wall", 8}}});
}

std::vector<std::string> dataScenes() { return {"cornell-box", "curved-room", "paper-room", "pyramid-room"}; }

Scene dataScene(const std::string& name) { return loadScene(std::string(HEMITEX_DATA) + "/" + name + ".obj"); }

/// A scene drawn in one way: the visible element of each pixel of a view.
class Drawing {
 public:
  Drawing(const Scene& scene, const Discretization& discretization, const IdSettings& ids)
      : scene_(scene),
        discretization_(discretization),
        layout_(layOut(discretization, ids)),
        renderer_(makeDrawList(scene, discretization, layout_)) {}

  const IdLayout& layout() const { return layout_; }
  ProjectedFormFactors rows(int resolution) { return {scene_, discretization_, layout_, renderer_, {resolution}}; }

  std::vector<std::optional<std::uint32_t>> elementsSeen(std::span<const raster::Face> faces) {
    std::vector<std::optional<std::uint32_t>> elements;
    for (const raster::ItemBuffer& buffer : render(renderer_, faces, {}))
      for (const ItemId id : buffer.ids) elements.push_back(elementOf(discretization_, layout_, id));
    return elements;
  }

 private:
  const Scene& scene_;
  const Discretization& discretization_;
  IdLayout layout_;
  raster::SoftwareRenderer renderer_;
};

/// The faces of a randomly tilted hemicube at a random point inside the scene's bounds.
std::vector<raster::Face> tiltedFaces(const Scene& scene, unsigned seed, int resolution) {
  std::mt19937 random(seed);
  const auto draw = [&] { return double(random()) / 4294967296.0 - 0.5; };
  const glm::dvec3 eye = 0.4 * scene.extent * glm::dvec3(draw(), draw(), draw());
  const glm::dvec3 normal = glm::normalize(glm::dvec3(draw(), draw(), draw()));
  return facesOver(hemicubeFaces(resolution), eye, normal, glm::dvec3(draw(), draw(), draw()), 1e-3 * scene.extent);
}

/// The distance of two elements of one surface, in texels between their own texels along the farther axis.
int texelsApart(const Discretization& discretization, std::uint32_t a, std::uint32_t b) {
  const Element &first = discretization.elements[a], &second = discretization.elements[b];
  const int columns = discretization.grids[first.surface].columns;
  const int from = int(first.texel), to = int(second.texel);
  return std::max(std::abs(from % columns - to % columns), std::abs(from / columns - to / columns));
}

}  // namespace

TEST_CASE("idOf and elementOf are inverse for all ways of index maps", "[index maps]") {
  const Scene scene = mixedScene();
  const Discretization discretization = mixedGrids(scene);
  for (const Way& way : allWays()) {
    const IdLayout layout = layOut(discretization, way.ids);
    INFO(way.name);
    std::set<ItemId> ids;
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
      const ItemId id = idOf(discretization, layout, e);
      REQUIRE(id < raster::backId(layout.format));
      REQUIRE(elementOf(discretization, layout, id) == e);
      ids.insert(id);
    }
    CHECK(ids.size() == discretization.elements.size());
    CHECK_FALSE(elementOf(discretization, layout, raster::backId(layout.format)));
    CHECK_FALSE(elementOf(discretization, layout, raster::backgroundId(layout.format)));
    CHECK_NOTHROW(raster::validate(makeDrawList(scene, discretization, layout)));
  }
}

TEST_CASE("layOut uses as many item IDs as there are texels of surfaces, or elements", "[index maps]") {
  const Scene scene = mixedScene();
  const Discretization discretization = mixedGrids(scene);
  std::size_t texels = 0;
  for (const Grid& grid : discretization.grids) texels += grid.elementOfTexel.size();
  REQUIRE(texels > discretization.elements.size());
  for (Way& way : allWays()) {
    way.ids.format = "r5g6b5";
    const IdLayout layout = layOut(discretization, way.ids);
    INFO(way.name);
    std::size_t decoded = 0;
    for (ItemId id = 0; id <= raster::backgroundId(layout.format); ++id)
      decoded += elementOf(discretization, layout, id).has_value();
    CHECK(decoded == (way.name == "unique" ? discretization.elements.size() : texels));
  }
}

TEST_CASE("makeDrawList draws the same elements for all ways, except at texel borders of packed pages",
          "[index maps]") {
  constexpr int resolution = 64;
  for (const std::string& name : dataScenes()) {
    const Scene scene = dataScene(name);
    const Discretization discretization = discretize(scene, {.texels = 16});
    Drawing shared(scene, discretization, {});
    for (const Way& way : allWays()) {
      INFO(name << ", " << way.name);
      Drawing drawing(scene, discretization, way.ids);
      const bool isScaled = way.ids.page.has_value();
      std::size_t different = 0;
      for (unsigned seed = 0; seed < 4; ++seed) {
        const auto faces = tiltedFaces(scene, seed, resolution);
        const auto expected = shared.elementsSeen(faces), seen = drawing.elementsSeen(faces);
        for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
          if (seen[pixel] == expected[pixel]) continue;
          ++different;
          REQUIRE(isScaled);
          REQUIRE((seen[pixel] && expected[pixel]));
          REQUIRE(discretization.elements[*seen[pixel]].surface == discretization.elements[*expected[pixel]].surface);
        }
      }
      // A border between texels moves by at most 2^-24 of the page's side, which is 4e-6 texels. Of the 49152 samples
      // almost none is that close to a border.
      CHECK(different <= 4);
    }
  }
}

TEST_CASE("rows with unaligned offsets and integer add equal those with aligned offsets", "[index maps]") {
  for (const std::string& name : dataScenes()) {
    const Scene scene = dataScene(name);
    const Discretization discretization = discretize(scene, {.texels = 13, .patch = 13});
    Drawing aligned(scene, discretization, {}),
        unaligned(scene, discretization, {"r8g8b8a8", Blend::IntegerAdd, false});
    ProjectedFormFactors expected = aligned.rows(32), rows = unaligned.rows(32);
    const auto patches = std::uint32_t(discretization.patches.list.size());
    for (std::uint32_t patch = 0; patch < patches; patch += 1 + patches / 40) {
      const FormFactorRow a = expected.ofPatch(discretization.patches.list[patch]),
                          b = rows.ofPatch(discretization.patches.list[patch]);
      INFO(name << ", patch " << patch);
      REQUIRE(a.elements == b.elements);
      REQUIRE(a.shares == b.shares);
      REQUIRE(a.background == b.background);
      REQUIRE(a.back == b.back);
    }
  }
}

TEST_CASE("makeDrawList keeps samples on the borders of charts inside their surface in a packed page", "[index maps]") {
  // A wall of 8 x 8 tiles fills a view of 64 x 64 pixels. It is shifted by half a pixel, so that all borders of tiles
  // pass through samples. The charts are rotated and mirrored in all eight ways. So on some tile the border that covers
  // the sample lies at u = 1 or v = 1. There the next texel of the page belongs to another surface.
  constexpr int resolution = 64, tiles = 8;
  const auto at = [](int i) { return -1 + (2 * i * (resolution / tiles) + 1.0) / resolution; };
  std::vector<Surface> surfaces;
  std::map<std::string, GridSize> texels;
  for (int row = 0; row < tiles; ++row)
    for (int column = 0; column < tiles; ++column) {
      std::array<glm::dvec3, 4> corner{{{at(column), at(row), -1},
                                        {at(column + 1), at(row), -1},
                                        {at(column + 1), at(row + 1), -1},
                                        {at(column), at(row + 1), -1}}};
      const int turn = (column + row) % 4, number = row * tiles + column;
      std::rotate(corner.begin(), corner.begin() + turn, corner.end());
      const std::string name = "tile" + std::to_string(number);
      surfaces.push_back(quad(name, corner));
      if (number / 4 % 2 == 1)
        for (Triangle& triangle : surfaces.back().triangles)
          for (glm::dvec2& chart : triangle.chart) chart.x = 1 - chart.x;
      texels[name] = 1 + number % 8;
    }
  const Scene scene = sceneOf(std::move(surfaces));
  const Discretization discretization = discretize(scene, {.surfaceTexels = texels});
  const raster::Face face{-glm::vec3(scene.origin),      {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.1f, resolution,
                          {0, 0, resolution, resolution}};
  Drawing shared(scene, discretization, {});
  const auto expected = shared.elementsSeen({&face, 1});
  std::size_t seenPixels = 0;
  for (const int page : {8, 16, 32, 64})
    for (const IndexMaps way : {IndexMaps::Packed, IndexMaps::Shared}) {
      Drawing packed(scene, discretization, {"r8g8b8a8", Blend::ClampedAdd, true, way, page});
      const auto seen = packed.elementsSeen({&face, 1});
      for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
        INFO("page " << page << ", pixel " << pixel % resolution << ", " << pixel / resolution);
        REQUIRE(seen[pixel].has_value() == expected[pixel].has_value());
        if (!seen[pixel]) continue;
        ++seenPixels;
        REQUIRE(discretization.elements[*seen[pixel]].surface == discretization.elements[*expected[pixel]].surface);
        // A sample on a border between texels may change sides.
        REQUIRE(texelsApart(discretization, *seen[pixel], *expected[pixel]) <= 1);
      }
    }
  CHECK(seenPixels > 8 * 60 * 60);
}

TEST_CASE("layOut with packed pages shares one index map, with one offset per page", "[index maps]") {
  // 100 grids of 8 x 8 fill 100 / 64 pages of 64 x 64.
  std::vector<Surface> surfaces;
  for (int i = 0; i < 100; ++i) surfaces.push_back(flat("wall" + std::to_string(i), rectangle({0, 0}, {1, 1})));
  const Scene scene = sceneOf(std::move(surfaces));
  const Discretization discretization = discretize(scene, {.texels = 8});
  const IdLayout layout = layOut(discretization, {.indexMaps = IndexMaps::Packed});
  const raster::DrawList list = makeDrawList(scene, discretization, layout);
  std::set<ItemId> offsets;
  for (const raster::Draw& draw : list.draws) offsets.insert(draw.offset);
  CHECK(offsets == std::set<ItemId>{0, 4096});
  REQUIRE(list.indexMaps.size() == 1);
  CHECK(list.indexMaps[0].width == 64);
  CHECK(list.indexMaps[0].height == 64);
  for (const raster::Draw& draw : list.draws) CHECK(draw.indexMap == 0);
}

TEST_CASE("layOut with unique maps lets texels share item IDs, so that elements have any shape", "[index maps]") {
  // A quadtree of a 4 x 4 grid: one quarter is one leaf, one is single texels, the others have an L of three and a
  // single texel.
  const Scene scene = sceneOf({quad("wall", {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}}),
                               quad("far", {{{9, 9, 9}, {9, 10, 9}, {9, 10, 10}, {9, 9, 10}}})});
  Discretization discretization = discretize(scene, {.texels = 4, .surfaceTexels = {{"far", 1}}});
  const std::vector<std::uint32_t> shapes{0, 0, 1, 2,  //
                                          0, 0, 3, 4,  //
                                          5, 5, 6, 6,  //
                                          5, 7, 6, 6};
  Grid& grid = discretization.grids[0];
  grid.elementOfTexel = shapes;
  grid.elementCount = 8;
  discretization.grids[1].firstElement = 8;
  discretization.grids[1].elementOfTexel = {8};
  discretization.elements.clear();
  for (const std::uint32_t texel : {0u, 2u, 3u, 6u, 7u, 8u, 10u, 13u})
    discretization.elements.push_back({.area = 1, .surface = 0, .texel = texel});
  discretization.elements.push_back({.area = 1, .surface = 1});
  const raster::Face face{-glm::vec3(scene.origin), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.1f, 32, {0, 0, 32, 32}};
  for (const Way& way : allWays()) {
    Drawing drawing(scene, discretization, way.ids);
    const auto seen = drawing.elementsSeen({&face, 1});
    INFO(way.name);
    for (std::size_t pixel = 0; pixel < seen.size(); ++pixel)
      REQUIRE(seen[pixel] == shapes[pixel / 32 / 8 * 4 + pixel % 32 / 8]);
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
      CHECK(elementOf(discretization, drawing.layout(), idOf(discretization, drawing.layout(), e)) == e);
  }
  const IdLayout unique = layOut(discretization, {.indexMaps = IndexMaps::Unique});
  const raster::DrawList list = makeDrawList(scene, discretization, unique);
  CHECK(list.blend == Blend::Replace);
  REQUIRE(list.indexMaps.size() == 1);
  CHECK(list.indexMaps[0].ids == shapes);
  CHECK(list.draws[1].offset == 8);
}

TEST_CASE("layOut with unique maps needs as many item IDs as there are elements", "[index maps]") {
  // r5g6b5 has 65534 usable item IDs: a surface of 255 x 256 texels and 254 of one.
  std::vector<Surface> surfaces{flat("wall", rectangle({0, 0}, {1, 1}))};
  for (int i = 0; i < 254; ++i) surfaces.push_back(flat("single" + std::to_string(i), rectangle({0, 0}, {1, 1})));
  const Scene scene = sceneOf(std::move(surfaces));
  Discretization discretization = discretize(scene, {.texels = 1, .surfaceTexels = {{"wall", 255}}});
  const IdSettings ids{.format = "r5g6b5", .indexMaps = IndexMaps::Unique};
  CHECK(layOut(discretization, ids).pages.back().offset == 255 * 255 + 253);
  Grid more;
  more.elementCount = 65535 - (255 * 255 + 254);
  discretization.grids.push_back(more);
  CHECK_THROWS_AS(layOut(discretization, ids), raster::InputError);
  --discretization.grids.back().elementCount;
  CHECK_NOTHROW(layOut(discretization, ids));
}

TEST_CASE("minPage is the smallest power of two that holds the largest surface", "[index maps]") {
  const Scene scene = sceneOf({flat("wall", rectangle({0, 0}, {1, 1}))});
  const Discretization discretization = discretize(scene, {.texels = 65});
  for (const IndexMaps way : {IndexMaps::Shared, IndexMaps::Packed}) {
    const auto fits = [&](int page) {
      try {
        layOut(discretization, {.indexMaps = way, .page = page});
        return true;
      } catch (const raster::InputError&) {
        return false;
      }
    };
    for (const int page : {0, -64, 1, 64, 96, 129, 8192}) CHECK_FALSE(fits(page));
    for (const int page : {128, 256, 4096}) CHECK(fits(page));
  }
  CHECK(defaultPage(discretization) == 128);
  CHECK(defaultPage(discretize(scene, {.texels = 64})) == 64);
  CHECK(defaultPage(discretize(scene, {.texels = 1})) == 64);
}
