// The reference renderer and evaluateRules give the same item IDs at every pixel.
#include "reference/conformance/trace/rational_rasterizer.h"

#include <catch2/catch.hpp>

#include "tests/support/raster_scenes.h"

using namespace hemitex;

TEST_CASE("evaluateRules equals the renderer where triangles are a few pixels wide", "[rational]") {
  const raster::DrawList list = tests::smallTriangles(100);
  raster::Face mirrored = tests::frontFace(64);
  mirrored.x = -mirrored.x;
  mirrored.scissor = {17, 9, 31, 40};
  for (const raster::Face& face : {tests::frontFace(64), mirrored})
    CHECK(tests::drawOne(list, face).ids == reference::evaluateRules(list, face).ids);
}
