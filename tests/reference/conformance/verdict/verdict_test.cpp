// The verdicts on a device: a device within its profile has no errors, and one wrong item ID is an error.
#include "reference/conformance/verdict/verdict.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/verdict/pixel_judge.h"
#include "tests/support/judged_wall.h"
#include "tests/support/simulated_device.h"

using namespace hemitex;
using reference::DeviceProfile;
using reference::PixelVerdict;
using tests::SimulatedDevice;

namespace {

reference::TestVector vectorOf(const raster::DrawList& list, const raster::Face& face) {
  reference::TestVector vector;
  vector.list = list;
  vector.faces = {{"top", face, "top.u32", ""}};
  return vector;
}

reference::VerdictCounts countsOf(const raster::DrawList& list, const raster::Face& face,
                                  const raster::ItemBuffer& found, const DeviceProfile& profile = {}) {
  return countVerdicts(reference::judge(vectorOf(list, face), {&found, 1}, profile));
}

std::uint64_t count(const reference::VerdictCounts& counts, PixelVerdict verdict) {
  return counts[static_cast<std::size_t>(verdict)];
}

std::uint64_t errorsOf(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face,
                       const DeviceProfile& profile = {}) {
  return count(countsOf(list, face, drawOn(device, list, face), profile), PixelVerdict::Error);
}

/// A wall of 4 x 4 texels seen straight on by 16 x 16 pixels: each texel is 4 x 4 pixels, and every sample lies an
/// eighth of a texel or more inside its texel.
struct Wall {
  raster::DrawList list = tests::plainList();
  raster::Face face = tests::frontFace(16);

  Wall() {
    list.indexMaps.push_back(tests::countingMap(4, 4));
    tests::addDraw(list, 0x100, {}, 0);
    tests::addTriangle(list, {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}}, {{0, 0}, {1, 0}, {1, 1}});
    tests::addTriangle(list, {{-1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, {{0, 0}, {1, 1}, {0, 1}});
  }
};

/// Profiles of devices from good to poor.
std::vector<DeviceProfile> profiles() {
  DeviceProfile coarse;
  coarse.vertexError = 20000;  // several sub-pixels at 16 pixels a side
  coarse.subpixelBits = 4;
  coarse.texelPrecision = 0.1;
  coarse.depthFormat = reference::DepthFormat::Unorm16;
  DeviceProfile truncating;
  truncating.snapRounding = reference::SnapRounding::Truncate;
  DeviceProfile fine;
  fine.subpixelBits = 12;
  return {{}, coarse, truncating, fine};
}

}  // namespace

TEST_CASE("judge finds every pixel exact that the rules draw", "[verdict]") {
  for (std::uint64_t k = 0; k < reference::randomFamilies().size(); ++k) {
    const reference::TestVector vector = reference::interleavedRandomVector(1, k);
    const reference::Verdict verdict = reference::judge(vector, reference::render(vector), {});
    INFO(vector.name);
    std::uint64_t pixels = 0;
    for (const reference::FaceVerdict& face : verdict.faces) pixels += face.pixels.size();
    CHECK(count(countVerdicts(verdict), PixelVerdict::Exact) == pixels);
  }
}

TEST_CASE("judge finds no error in a device within its profile", "[verdict]") {
  std::uint64_t explained = 0;
  for (const DeviceProfile& profile : profiles())
    for (std::uint32_t draw = 0; draw < 40 * reference::randomFamilies().size(); ++draw) {
      const reference::TestVector vector = reference::interleavedRandomVector(2, draw);
      const raster::Face& face = vector.faces[0].face;
      const SimulatedDevice device{profile, draw, draw % 2 == 1};
      const raster::ItemBuffer found = drawOn(device, vector.list, face);
      const auto counts = countsOf(vector.list, face, found, profile);
      INFO(vector.name << ", draw " << draw << ", vertex error " << profile.vertexError << ", " << profile.subpixelBits
                       << " bits");
      CHECK(count(counts, PixelVerdict::Error) == 0);
      explained += found.ids.size() - count(counts, PixelVerdict::Exact);
    }
  // The devices do err: otherwise nothing was tested.
  CHECK(explained > 1000);
}

TEST_CASE("judge finds no error in a device within its profile that draws version 2", "[verdict]") {
  for (const std::string family :
       {"holes", "culled-sides", "two-sided", "triangle-numbers", "depth-tests", "viewports", "clip-space"}) {
    std::uint64_t explained = 0;
    for (const DeviceProfile& profile : profiles())
      for (std::uint32_t seed = 0; seed < 400; ++seed) {
        const reference::TestVector vector = reference::randomVector(seed, family);
        const raster::Face& face = vector.faces[0].face;
        const SimulatedDevice device{profile, seed, seed % 2 == 1};
        const raster::ItemBuffer found = drawOn(device, vector.list, face);
        const auto counts = countsOf(vector.list, face, found, profile);
        INFO(vector.name << ", vertex error " << profile.vertexError << ", " << profile.subpixelBits << " bits");
        CHECK(count(counts, PixelVerdict::Error) == 0);
        explained += found.ids.size() - count(counts, PixelVerdict::Exact);
      }
    INFO(family);
    CHECK(explained > 100);
  }
}

TEST_CASE("judge finds errors in a device that fills holes or draws culled triangles", "[verdict]") {
  for (const std::string family : {"holes", "culled-sides", "two-sided"}) {
    std::uint64_t wrong = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const reference::TestVector vector = reference::randomVector(seed, family);
      raster::DrawList changed = vector.list;
      for (raster::IndexMap& map : changed.indexMaps)
        std::replace(map.ids.begin(), map.ids.end(), raster::holeTexel, 0U);
      for (raster::Draw& draw : changed.draws) draw.cull = raster::Cull::None;
      const raster::Face& face = vector.faces[0].face;
      wrong += count(countsOf(vector.list, face, tests::drawOne(changed, face)), PixelVerdict::Error) > 0;
    }
    INFO(family);
    CHECK(wrong > 50);
  }
}

TEST_CASE("judge finds errors in a device with another depth test, sample or range of z", "[verdict]") {
  const auto wrongVectors = [](const std::string& family, const auto& change) {
    std::uint64_t wrong = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const reference::TestVector vector = reference::randomVector(seed, family);
      CHECK_FALSE(hasErrors(judge(vector, render(vector), {})));
      reference::TestVector changed = vector;
      change(changed);
      wrong += hasErrors(judge(vector, render(changed), {}));
    }
    return wrong;
  };
  CHECK(wrongVectors("depth-tests", [](auto& vector) { vector.list.depthTest = raster::DepthTest::Nearer; }) > 40);
  CHECK(wrongVectors("viewports", [](auto& vector) {
          for (reference::VectorFace& face : vector.faces) face.face.sample = raster::SamplePlace::Corner;
        }) > 20);
  CHECK(wrongVectors("clip-space", [](auto& vector) { vector.list.clipDepth = raster::ClipDepth::MinusOneToOne; }) >
        20);
  CHECK(wrongVectors("clip-space", [](auto& vector) {
          for (float& z : vector.list.clipZ) z = -z;
        }) > 50);
}

TEST_CASE("judge explains no count of samples that passed", "[verdict]") {
  reference::TestVector vector = reference::randomVector(3, "clip-space");
  vector.list.value = raster::PixelValue::PassedSamples;
  std::vector<raster::ItemBuffer> found = render(vector);
  for (raster::ItemId& id : found[0].ids) ++id;
  CHECK(count(countVerdicts(judge(vector, found, {})), PixelVerdict::Error) == found[0].ids.size());
}

TEST_CASE("judge finds errors in a device three sub-pixels beyond its profile", "[verdict]") {
  std::uint64_t right = 0, wrong = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const reference::TestVector vector = reference::randomVector(seed, "generic");
    right += errorsOf({{}, 1}, vector.list, vector.faces[0].face);
    wrong += errorsOf({.profile = {}, .seed = 1, .shift = 3}, vector.list, vector.faces[0].face);
  }
  CHECK(right == 0);
  CHECK(wrong > 0);
}

TEST_CASE("judge explains a shift of a quarter texel and finds errors in one of half a texel", "[verdict]") {
  const Wall wall;
  DeviceProfile quarter;
  quarter.texelPrecision = 0.25;
  CHECK(errorsOf({.profile = {}, .texelShift = 0.5}, wall.list, wall.face) > 0);
  const auto counts =
      countsOf(wall.list, wall.face, tests::drawOn({.profile = {}, .texelShift = 0.24}, wall.list, wall.face), quarter);
  CHECK(count(counts, PixelVerdict::Error) == 0);
  CHECK(count(counts, PixelVerdict::Texel) > 0);
}

TEST_CASE("judge finds an error in one wrong element, even the next one", "[verdict]") {
  const Wall wall;
  const raster::ItemBuffer right = tests::drawOne(wall.list, wall.face);
  for (std::size_t pixel = 0; pixel < right.ids.size(); pixel += 7)
    for (const raster::ItemId id : {right.ids[pixel] + 1, right.ids[pixel] - 1, right.ids[pixel] ^ 0x80000000u}) {
      raster::ItemBuffer found = right;
      found.ids[pixel] = id;
      const auto counts = countsOf(wall.list, wall.face, found);
      INFO("pixel " << pixel << ", item ID " << id);
      CHECK(count(counts, PixelVerdict::Error) == 1);
      CHECK(count(counts, PixelVerdict::Exact) == 255);
    }
}

TEST_CASE("judge finds two errors in two exchanged item IDs", "[verdict]") {
  const Wall wall;
  raster::ItemBuffer found = tests::drawOne(wall.list, wall.face);
  REQUIRE(found.ids[3] != found.ids[4]);
  std::swap(found.ids[3], found.ids[4]);
  CHECK(count(countsOf(wall.list, wall.face, found), PixelVerdict::Error) == 2);
}

TEST_CASE("judge finds an error in a hole at a shared edge, and none at the boundary of the mesh", "[verdict]") {
  // Moved to (-13/16, -13/16), the wall's first corner lies on the sample of pixel (1, 1): its left and its top side
  // run through the samples of column 1 and row 1, and the diagonal that its two triangles share through those of all
  // pixels (i, i). The vertex error moves corners by a sub-pixel or so; the triangles move together.
  const Wall wall;
  raster::DrawList list = wall.list;
  for (glm::vec3& position : list.positions) {
    if (position.x == -1) position.x = -13.0f / 16;
    if (position.y == -1) position.y = -13.0f / 16;
  }
  const raster::ItemBuffer right = tests::drawOne(list, wall.face);
  DeviceProfile profile;
  profile.vertexError = 2000;
  const raster::ItemId background = raster::backgroundId(list.format);
  for (std::size_t row = 1; row < 15; ++row)
    for (std::size_t column = 1; column < 15; ++column) {
      raster::ItemBuffer found = right;
      const std::size_t pixel = row * 16 + column;
      const bool onBoundary = row == 1 || column == 1;
      REQUIRE(right.ids[pixel] != background);
      found.ids[pixel] = background;
      const auto counts = countsOf(list, wall.face, found, profile);
      INFO("column " << column << ", row " << row);
      CHECK(count(counts, PixelVerdict::Coverage) == (onBoundary ? 1u : 0u));
      CHECK(count(counts, PixelVerdict::Error) == (onBoundary ? 0u : 1u));
    }
}

TEST_CASE("judge finds errors of the fill rule where no vertex can move, and none with the edge rule any",
          "[verdict]") {
  // Corners on samples: exact in binary32, and no error of the vertex stage reaches the next sub-pixel.
  raster::DrawList list = tests::plainList();
  tests::addDraw(list, 7);
  tests::addTriangle(list, {{-0.8125f, -0.8125f, 1}, {0.8125f, -0.8125f, 1}, {-0.8125f, 0.8125f, 1}});
  const raster::Face face = tests::frontFace(16);
  const raster::ItemBuffer found = tests::drawOn({.profile = {}, .bottomRight = true}, list, face);
  const auto counts = countsOf(list, face, found);
  CHECK(count(counts, PixelVerdict::Error) > 20);
  CHECK(count(counts, PixelVerdict::Exact) + count(counts, PixelVerdict::Error) == 256);
  DeviceProfile anyRule;
  anyRule.edgeRule = reference::EdgeRule::Any;
  CHECK(count(countsOf(list, face, found, anyRule), PixelVerdict::Error) == 0);
}

TEST_CASE("judge explains the surface behind within the depth tolerance, and no further", "[verdict]") {
  // Two walls at w and w (1 + e): their depths 1 - n/w differ by n e / w, here 2^-6 e. The tolerance of two stored
  // depths is 8 units of 2^-23, reached at e = 2^-14.
  for (const float e : {0x1p-15f, 0x1p-13f}) {
    raster::DrawList list = tests::plainList();
    for (const float w : {1.0f, 1 + e}) {
      tests::addDraw(list, list.draws.empty() ? 1 : 2);
      tests::addTriangle(list, {{-3 * w, -3 * w, w}, {9 * w, -3 * w, w}, {-3 * w, 9 * w, w}});
    }
    raster::Face face = tests::frontFace(16);
    face.nearDistance = 0x1p-6f;
    raster::ItemBuffer found = tests::drawOne(list, face);
    std::fill(found.ids.begin(), found.ids.end(), 2u);
    DeviceProfile profile;
    profile.vertexError = 1;
    const auto counts = countsOf(list, face, found, profile);
    CHECK(count(counts, e < 0x1p-14f ? PixelVerdict::Depth : PixelVerdict::Error) == 256);
  }
}

TEST_CASE("judge decides each pixel independently of tiles, neighbours and scissor rectangles", "[verdict]") {
  // Triangles all over a view of five by five tiles, and through a rectangle that begins and ends inside tiles; every
  // item ID is a neighbour's. Brute force judges each pixel alone, by all triangles.
  std::mt19937 random(4);
  raster::DrawList list = tests::plainList();
  for (raster::ItemId id = 0; id < 40; ++id) {
    const glm::vec3 middle(tests::uniform(random, -1, 1), tests::uniform(random, -1, 1), 1);
    const auto corner = [&] {
      return middle + glm::vec3(tests::uniform(random, -0.4f, 0.4f), tests::uniform(random, -0.4f, 0.4f), 0);
    };
    const glm::vec3 a = corner(), b = corner(), c = corner();
    tests::addDraw(list, id);
    tests::addTriangle(list, {a, b, c});
  }
  DeviceProfile profile;
  profile.vertexError = 10000;  // about ten sub-pixels
  profile.looseClipping = false;
  for (const raster::Scissor& scissor : {raster::Scissor{0, 0, 80, 80}, raster::Scissor{7, 21, 66, 38}}) {
    raster::Face face = tests::frontFace(80);
    face.scissor = scissor;
    raster::ItemBuffer found = tests::drawOne(list, face);
    std::rotate(found.ids.begin(), found.ids.begin() + 1, found.ids.end());
    const reference::Verdict verdict = reference::judge(vectorOf(list, face), {&found, 1}, profile);
    const raster::ItemBuffer& expected = verdict.faces[0].expected;

    const auto triangles = placeTriangles(list, face, profile, false, [](const auto&) { return true; });
    std::vector<const reference::DeviceTriangle*> all;
    for (const reference::DeviceTriangle& triangle : triangles) all.push_back(&triangle);
    const reference::JudgedFace judged = judgedFace(list, face, profile);
    reference::VerdictCounts counts{};
    std::size_t pixel = 0;
    bool holds = true;
    for (int row = scissor.row; row < scissor.row + scissor.height; ++row)
      for (int column = scissor.column; column < scissor.column + scissor.width; ++column, ++pixel) {
        const PixelVerdict alone = found.ids[pixel] == expected.ids[pixel]
                                       ? PixelVerdict::Exact
                                       : judgeId(judged, all, raster::sampleOf(column, row), found.ids[pixel]);
        holds &= verdict.faces[0].pixels[pixel] == alone;
        ++counts[static_cast<std::size_t>(alone)];
      }
    CHECK(holds);
    CHECK(counts == countVerdicts(verdict));
    for (const PixelVerdict kind : {PixelVerdict::Exact, PixelVerdict::Coverage, PixelVerdict::Error})
      CHECK(count(counts, kind) > 10);
  }
}

TEST_CASE("judge finds an error where only loose clipping explains and the profile forbids it", "[verdict]") {
  std::uint64_t loose = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const reference::TestVector vector = reference::randomVector(seed, "guard-band");
    const raster::Face& face = vector.faces[0].face;
    const raster::ItemBuffer found = tests::drawOn({{}, seed, true}, vector.list, face);
    DeviceProfile forbidding;
    forbidding.looseClipping = false;
    auto allowed = countsOf(vector.list, face, found);
    const auto forbidden = countsOf(vector.list, face, found, forbidding);
    CHECK(count(forbidden, PixelVerdict::LooseClipping) == 0);
    loose += count(allowed, PixelVerdict::LooseClipping);
    std::swap(allowed[static_cast<std::size_t>(PixelVerdict::LooseClipping)],
              allowed[static_cast<std::size_t>(PixelVerdict::Error)]);
    CHECK(allowed == forbidden);
  }
  CHECK(loose > 0);
}

TEST_CASE("judge and hasErrors find one error in the last face of many", "[verdict]") {
  const Wall wall;
  reference::TestVector vector = vectorOf(wall.list, wall.face);
  vector.faces.push_back(vector.faces[0]);
  vector.faces[1].face.x = -vector.faces[1].face.x;
  std::vector<raster::ItemBuffer> found;
  for (const reference::VectorFace& face : vector.faces) found.push_back(tests::drawOne(wall.list, face.face));
  CHECK_FALSE(hasErrors(reference::judge(vector, found, {})));
  found[1].ids[255] = 5;
  const reference::Verdict verdict = reference::judge(vector, found, {});
  CHECK(hasErrors(verdict));
  CHECK(count(countVerdicts(verdict), PixelVerdict::Error) == 1);
  CHECK(count(countVerdicts(verdict), PixelVerdict::Exact) == 511);
}

TEST_CASE("judge never explains a triangle without an index map by a texel", "[verdict]") {
  // Every triangle lies on others, their corners in another order. A device that lets the later ones win shows item IDs
  // of equal depth, whichever of them rounding takes for the rules' own.
  for (const reference::TestVector& vector : reference::vectorSuite()) {
    if (vector.name != "same-triangle") continue;
    SimulatedDevice later;
    later.passes = std::less_equal<double>();
    std::vector<raster::ItemBuffer> found;
    for (const reference::VectorFace& face : vector.faces) found.push_back(drawOn(later, vector.list, face.face));
    const reference::VerdictCounts counts = countVerdicts(judge(vector, found, {}));
    CHECK(count(counts, PixelVerdict::Depth) > 100);
    CHECK(count(counts, PixelVerdict::Texel) == 0);
    CHECK(count(counts, PixelVerdict::Error) == 0);
  }
}

TEST_CASE("judge compares with the expected item buffers that it is given", "[verdict]") {
  const tests::JudgedWall wall;
  std::vector<raster::ItemBuffer> expected = wall.found;
  CHECK(countVerdicts(judge(wall.vector, expected, wall.found, {}))[0] == 96);
  expected[1].ids[3] ^= 1;
  const reference::Verdict verdict = judge(wall.vector, expected, wall.found, {});
  CHECK(countVerdicts(verdict)[0] == 95);
  CHECK(verdict.faces[1].pixels[3] != PixelVerdict::Exact);
}

TEST_CASE("judge with strictDepth finds a device whose equal depths pass, in every depth format", "[verdict]") {
  for (const reference::DepthFormat format :
       {reference::DepthFormat::Float32, reference::DepthFormat::Unorm24, reference::DepthFormat::Unorm16})
    for (const reference::TestVector& vector : reference::vectorSuite()) {
      if (vector.name != "equal-depths" && vector.name != "equal-depths-sloped") continue;
      INFO(vector.name << ", format " << static_cast<int>(format));
      const raster::Face& face = vector.faces[0].face;
      DeviceProfile profile;
      profile.depthFormat = format;
      profile.depthTolerance = 0.5;  // only rounding, which is the same for equal triangles
      SimulatedDevice less, lessOrEqual;
      less.profile = lessOrEqual.profile = profile;
      lessOrEqual.passes = std::less_equal<double>();
      const raster::ItemBuffer right = drawOn(less, vector.list, face), wrong = drawOn(lessOrEqual, vector.list, face);
      CHECK(right.ids == reference::render(vector)[0].ids);
      CHECK(count(countsOf(vector.list, face, wrong, profile), PixelVerdict::Depth) == 640);
      profile.strictDepth = true;
      CHECK(count(countsOf(vector.list, face, right, profile), PixelVerdict::Exact) == 1024);
      CHECK(count(countsOf(vector.list, face, wrong, profile), PixelVerdict::Error) == 640);
    }
}

TEST_CASE("judge with strictDepth excuses ties of triangles with other corners", "[verdict]") {
  // The reverse order of draws keeps the last of equal depths.
  for (const reference::TestVector& vector : reference::vectorSuite()) {
    reference::TestVector reversed = vector;
    std::reverse(reversed.list.draws.begin(), reversed.list.draws.end());
    DeviceProfile strict;
    strict.strictDepth = true;
    INFO(vector.name);
    const std::vector<raster::ItemBuffer> found = reference::render(reversed);
    CHECK(!hasErrors(reference::judge(vector, found, {})));
    const bool hasTwins = vector.name == "equal-depths" || vector.name == "equal-depths-sloped";
    CHECK(hasErrors(reference::judge(vector, found, strict)) == hasTwins);
  }
}
