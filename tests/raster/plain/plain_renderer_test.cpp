// PlainRenderer and SoftwareRenderer share view, clip and snap: equal item IDs mean that the rest of both follows the
// rules.
#include "raster/plain/plain_renderer.h"

#include <catch2/catch.hpp>

#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

void checkEqual(const raster::DrawList& list, const std::vector<raster::Face>& faces,
                const std::vector<std::uint32_t>& skipped = {}) {
  const std::vector<raster::ItemBuffer> plain = render(raster::PlainRenderer(list), faces, skipped);
  const std::vector<raster::ItemBuffer> fast = render(raster::SoftwareRenderer(list), faces, skipped);
  REQUIRE(plain.size() == faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    INFO("face " << f);
    CHECK(plain[f].width == faces[f].scissor.width);
    CHECK(plain[f].height == faces[f].scissor.height);
    CHECK(plain[f].ids == fast[f].ids);
  }
}

}  // namespace

TEST_CASE("PlainRenderer equals SoftwareRenderer on triangles that cross each other and the clip planes", "[plain]") {
  checkEqual(crossingTriangles(), facesAndParts());
}

TEST_CASE("PlainRenderer equals SoftwareRenderer on small triangles with corners on samples", "[plain]") {
  checkEqual(smallTriangles(300), facesAndParts());
}

TEST_CASE("PlainRenderer equals SoftwareRenderer without the skipped triangles", "[plain]") {
  std::vector<std::uint32_t> skipped;
  for (std::uint32_t t = 0; t < 2000; t += 1 + t % 3) skipped.push_back(t);
  checkEqual(crossingTriangles(), facesAndParts(), skipped);
}

TEST_CASE("PlainRenderer refuses lists and faces that break the rules", "[plain]") {
  raster::DrawList list = crossingTriangles();
  raster::Face face = threeFaces()[0];
  face.nearDistance = 0;
  CHECK_THROWS_AS(render(raster::PlainRenderer(list), std::vector{face}), raster::InputError);
  list.indices.back() = static_cast<std::uint32_t>(list.positions.size());
  CHECK_THROWS_AS(raster::PlainRenderer(list), raster::InputError);
}
