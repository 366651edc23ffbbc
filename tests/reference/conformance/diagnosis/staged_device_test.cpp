// A staged device draws the same item IDs whether it shares stages with the rules or computes all of them itself.
#include "reference/conformance/diagnosis/staged_device.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "tests/support/staged_drawing.h"

using namespace hemitex;
using reference::StagedDevice;
using reference::TestVector;
using tests::drawAll;

namespace {

using FaceIds = std::vector<std::vector<raster::ItemId>>;

FaceIds idsOf(const std::vector<raster::ItemBuffer>& buffers) {
  FaceIds ids;
  for (const raster::ItemBuffer& buffer : buffers) ids.push_back(buffer.ids);
  return ids;
}

TestVector named(const std::string& name) {
  for (const TestVector& vector : reference::vectorSuite())
    if (vector.name == name) return vector;
  FAIL(name);
  return {};
}

}  // namespace

TEST_CASE("drawOn places triangles again where the upload splits draws, with the same item IDs", "[diagnosis]") {
  StagedDevice splitting;
  splitting.upload = [](raster::DrawList& list) {
    std::vector<raster::Draw> draws;
    for (const raster::Draw& draw : list.draws)
      for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
        draws.push_back(draw);
        draws.back().first = first;
        draws.back().count = 3;
      }
    list.draws = draws;
  };
  for (const char* name : {"five-faces", "shared-vertices", "perspective-clipped"}) {
    INFO(name);
    const TestVector vector = named(name);
    CHECK(idsOf(drawAll(splitting, vector)) == idsOf(drawAll(StagedDevice{}, vector)));
  }
}

TEST_CASE("drawOn with a camera draws what a vector with that view shows", "[diagnosis]") {
  StagedDevice flipped;
  flipped.camera = [](std::span<const raster::Face> faces, std::size_t f) {
    raster::Face face = faces[f];
    face.y = -face.y;
    return face;
  };
  const TestVector vector = named("five-faces");
  TestVector seen = vector;
  for (reference::VectorFace& face : seen.faces) face.face.y = -face.face.y;
  CHECK(idsOf(drawAll(flipped, vector)) == idsOf(drawAll(StagedDevice{}, seen)));
}

TEST_CASE("withReadBack changes the item IDs of the rules as a device does that draws them itself", "[diagnosis]") {
  const auto reversed = [](const raster::Face&, raster::ItemBuffer& buffer) {
    std::reverse(buffer.ids.begin(), buffer.ids.end());
  };
  StagedDevice drawing;
  drawing.readBack = reversed;
  const TestVector vector = named("five-faces");
  const FaceIds rules = idsOf(drawAll(StagedDevice{}, vector)),
                found = idsOf(drawAll(reference::withReadBack(reversed), vector));
  CHECK(found == idsOf(drawAll(drawing, vector)));
  for (std::size_t f = 0; f < rules.size(); ++f)
    CHECK(std::equal(rules[f].begin(), rules[f].end(), found[f].rbegin(), found[f].rend()));
}

TEST_CASE("drawOn ends where no more rows are wanted", "[diagnosis]") {
  const TestVector vector = named("five-faces");
  int parts = 0;
  drawOn(StagedDevice{}, placeVector(vector), [&](const raster::ItemBuffer& part) {
    CHECK(part.ids.size() < static_cast<std::size_t>(part.width * vector.faces[0].face.scissor.height));
    return ++parts < 2;
  });
  CHECK(parts == 2);
}

TEST_CASE("drawOn with the default StagedGeometry draws the item IDs of the rules", "[diagnosis]") {
  StagedDevice device;
  device.geometry = reference::StagedGeometry();
  for (const char* name : {"five-faces-tilted", "frustum-sheet", "guard-band-sheet", "perspective-clipped", "backs"}) {
    INFO(name);
    const TestVector vector = named(name);
    CHECK(idsOf(drawAll(device, vector)) == idsOf(reference::render(vector)));
    CHECK(idsOf(drawAll(StagedDevice{}, vector)) == idsOf(reference::render(vector)));
  }
}

TEST_CASE("drawOn draws holes and culls by the facing that the device assumes", "[diagnosis]") {
  StagedDevice turned;
  turned.facing = [](reference::Facing side, const raster::Face&) { return otherSide(side); };
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const TestVector backsCulled = reference::randomVector(seed, "two-sided");
    TestVector frontsCulled = backsCulled;
    for (raster::Draw& draw : frontsCulled.list.draws) {
      draw.cull = raster::Cull::Front;
      draw.back = {};
    }
    CHECK(idsOf(drawAll(StagedDevice{}, backsCulled)) == idsOf(reference::render(backsCulled)));
    CHECK(idsOf(drawAll(turned, backsCulled)) == idsOf(reference::render(frontsCulled)));
  }
}

TEST_CASE("drawOn numbers triangles and tests depths by the rules of version 2", "[diagnosis]") {
  for (const std::string family : {"triangle-numbers", "depth-tests"})
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const TestVector vector = reference::randomVector(seed, family);
      INFO(vector.name);
      CHECK(idsOf(drawAll(StagedDevice{}, vector)) == idsOf(reference::render(vector)));
    }
}

TEST_CASE("drawOn with keepsDepth hides what lies behind the faces before", "[diagnosis]") {
  StagedDevice device;
  device.keepsDepth = true;
  TestVector vector = named("depth-stack");
  vector.faces.push_back(vector.faces[0]);
  const FaceIds once = idsOf(drawAll(StagedDevice{}, vector)), kept = idsOf(drawAll(device, vector));
  CHECK(kept[0] == once[0]);
  // Nothing is nearer than itself.
  CHECK(std::count(kept[1].begin(), kept[1].end(), 0xffffffff) == static_cast<std::ptrdiff_t>(kept[1].size()));
}
