// The reference renderer and evaluateRules give the same item IDs at every pixel.
#include "reference/trace/rational_rasterizer.h"

#include <catch2/catch.hpp>

#include "tests/support/triangle_families.h"

using namespace hemitex;

namespace {

void compareOnFamilies(int trianglesPerFamily) {
  for (const tests::TriangleFamily& family : tests::triangleFamilies()) {
    std::mt19937 random(2002);
    int differing = 0, covered = 0;
    for (int triangles = 0; triangles < trianglesPerFamily; triangles += family.trianglesPerCase) {
      const tests::DrawnCase drawn = family.make(random);
      const raster::ItemBuffer expected = reference::evaluateRules(drawn.list, drawn.face);
      const raster::ItemBuffer found = tests::drawOne(drawn.list, drawn.face);
      for (std::size_t p = 0; p < expected.ids.size(); ++p) {
        differing += found.ids[p] != expected.ids[p];
        covered += expected.ids[p] != raster::backgroundId(drawn.list.format);
      }
    }
    INFO(family.name);
    CHECK(differing == 0);
    CHECK(covered > 1000);
  }
}

}  // namespace

TEST_CASE("evaluateRules equals the renderer on every pixel of every family of triangles", "[rational]") {
  compareOnFamilies(2240);  // of nine families: 20,160
}

TEST_CASE("evaluateRules equals the renderer where triangles are a few pixels wide", "[rational]") {
  const raster::DrawList list = tests::smallTriangles(100);
  raster::Face mirrored = tests::frontFace(64);
  mirrored.x = -mirrored.x;
  mirrored.scissor = {17, 9, 31, 40};
  for (const raster::Face& face : {tests::frontFace(64), mirrored})
    CHECK(tests::drawOne(list, face).ids == reference::evaluateRules(list, face).ids);
}

// The target all_triangle_families runs it; the test above is a part of it.
TEST_CASE("evaluateRules equals the renderer on 200,000 triangles", "[.][all_triangle_families]") {
  compareOnFamilies(22400);
}
