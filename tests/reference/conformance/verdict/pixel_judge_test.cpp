// judgeId against closed forms, tested just inside and just outside of each bound.
#include "reference/conformance/verdict/pixel_judge.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using raster::ItemId;
using reference::DeviceProfile;
using reference::PixelVerdict;

namespace {

constexpr int resolution = 16;

/// A device that errs in nothing but what a test allows it.
DeviceProfile strictProfile() {
  DeviceProfile profile;
  profile.vertexError = 0;
  profile.texelPrecision = 0;
  profile.depthTolerance = 0;
  return profile;
}

/// Snaps to sixteenths of a pixel. What lies a 1/32 beside a sample is a tie: snapped to the sample or past it.
DeviceProfile coarseProfile() {
  DeviceProfile profile = strictProfile();
  profile.subpixelBits = 4;
  return profile;
}
constexpr double tie = 1.0 / 32;

PixelVerdict verdictAt(const raster::DrawList& list, const raster::Face& face, const DeviceProfile& profile, int column,
                       int row, ItemId found) {
  const auto all = [](const reference::DeviceTriangle&) { return true; };
  const auto triangles = placeTriangles(list, face, profile, false, all);
  std::vector<const reference::DeviceTriangle*> pointers;
  for (const reference::DeviceTriangle& triangle : triangles) pointers.push_back(&triangle);
  return judgeId(judgedFace(list, face, profile), pointers, raster::sampleOf(column, row), found);
}

/// A corner at (column, row) in pixels, at depth w.
glm::vec3 at(double column, double row, double w = 1) { return reference::Picture(resolution).point({column, row}, w); }

/// Adds a wall over the whole view and beyond, at depth w.
void addBackdrop(raster::DrawList& list, ItemId id, double w) {
  tests::addDraw(list, id);
  tests::addTriangle(list, {at(-8, -8, w), at(-8, 56, w), at(56, -8, w)});
}

}  // namespace

TEST_CASE("judgeId explains the next texel up to the texel precision from its border", "[verdict]") {
  // Texels of 4 x 2 pixels: samples lie an eighth or three of a texel from borders of columns, a quarter from those of
  // rows.
  raster::DrawList list = tests::plainList();
  list.indexMaps.push_back(tests::countingMap(4, 8));
  tests::addDraw(list, 0, {}, 0);
  reference::addQuad(list, {at(0, 0), at(16, 0), at(16, 16), at(0, 16)});
  struct Case {
    int column, row, texel, nextTexel;
    double distance;
  };
  for (const Case& each : {Case{4, 6, 3 * 4 + 1, 3 * 4 + 0, 0.125}, Case{7, 9, 4 * 4 + 1, 4 * 4 + 2, 0.125},
                           Case{5, 9, 4 * 4 + 1, 4 * 4 + 0, 0.375}, Case{4, 6, 3 * 4 + 1, 2 * 4 + 1, 0.25},
                           Case{7, 9, 4 * 4 + 1, 5 * 4 + 1, 0.25}, Case{4, 6, 3 * 4 + 1, 2 * 4 + 0, 0.25}}) {
    INFO("pixel " << each.column << ", " << each.row << ", texel " << each.nextTexel);
    DeviceProfile profile = strictProfile();
    const auto found = static_cast<ItemId>(each.nextTexel);
    CHECK(tests::drawOne(list, tests::frontFace(resolution))
              .ids[static_cast<std::size_t>(each.row * resolution + each.column)] == static_cast<ItemId>(each.texel));
    profile.texelPrecision = each.distance - 0.001;
    CHECK(verdictAt(list, tests::frontFace(resolution), profile, each.column, each.row, found) == PixelVerdict::Error);
    profile.texelPrecision = each.distance + 0.001;
    CHECK(verdictAt(list, tests::frontFace(resolution), profile, each.column, each.row, found) == PixelVerdict::Texel);
  }
}

TEST_CASE("judgeId moves texture coordinates by half of the depth errors", "[verdict]") {
  // A wall that fills the view, u or v from 0 to 1 along it. With w off by a factor within 1 - e and 1 + e its
  // corners, at 1, move by e: half an e of the spread. The weights of the interpolation move u by another half of it,
  // where 1 - e on one side meets 1 + e on the other. Two texels, and their border at e (1 +- 0.1) from the sample.
  constexpr double error = 0x1p-6;
  raster::Face face = tests::frontFace(resolution);
  face.eye = {0, 0, -1024};  // of |-1023| + |-1024| = 2047 at depth 1: the depth is off more than the picture
  DeviceProfile profile = strictProfile();
  profile.vertexError = error / 2047 * 0x1p24;
  for (const int axis : {0, 1})
    for (const double side : {1.0, -1.0})
      for (const double distance : {0.9 * error, 1.1 * error}) {
        raster::DrawList list = tests::plainList();
        list.indexMaps.push_back(axis == 0 ? tests::countingMap(2, 1) : tests::countingMap(1, 2));
        tests::addDraw(list, 0, {}, 0);
        reference::addQuad(list, {at(0, 0), at(16, 0), at(16, 16), at(0, 16)});
        for (glm::vec3& position : list.positions) position += face.eye;
        // The sample of pixel 8 lies 1/32 beyond the middle.
        for (glm::vec2& t : list.texcoords) {
          t[axis] += static_cast<float>(side * distance - 1.0 / 32);
          t[1 - axis] = 0;
        }
        const int column = axis == 0 ? 8 : 3, row = axis == 0 ? 3 : 8;
        const ItemId found = side > 0 ? 0 : 1;
        INFO("axis " << axis << ", side " << side << ", distance " << distance);
        CHECK(verdictAt(list, face, profile, column, row, found) ==
              (distance < error ? PixelVerdict::Texel : PixelVerdict::Error));
      }
}

TEST_CASE("judgeId explains the triangle behind within the error of both depths", "[verdict]") {
  // Depths 1 and 1 + e whose 1/w are off by factors within 1/(1 + r) and 1/(1 - r): the order may change where
  // 1 + e <= (1 + r)/(1 - r), at e = 2 r/(1 - r).
  const double roundoff = 0x1p-10;
  DeviceProfile rounding = strictProfile();
  rounding.vertexError = roundoff * 0x1p24;
  // Stored depths 1 - n/w off by 4 units of the last place of 1 each: the order may change where n e/(1 + e) <= 2^-20.
  DeviceProfile storing = strictProfile();
  storing.depthTolerance = 4;
  struct Case {
    DeviceProfile profile;
    float nearDistance;
    double bound;
  };
  for (const Case& each : {Case{rounding, 0.01f, 2 * roundoff / (1 - roundoff)}, Case{storing, 0x1p-6f, 0x1p-14},
                           Case{storing, 0x1p-9f, 0x1p-11}})
    for (const double part : {0.98, 1.02}) {
      raster::DrawList list = tests::plainList();
      addBackdrop(list, 1, 1);
      addBackdrop(list, 2, 1 + part * each.bound);
      const raster::Face face = tests::frontFace(resolution, each.nearDistance);
      INFO("bound " << each.bound << ", " << part);
      CHECK(verdictAt(list, face, each.profile, 8, 5, 2) == (part < 1 ? PixelVerdict::Depth : PixelVerdict::Error));
    }
}

TEST_CASE("judgeId lets the background hide what may be stored as the cleared depth", "[verdict]") {
  // 1 - n/w with an error of e is 1 where n/w <= e.
  for (const reference::DepthFormat format : {reference::DepthFormat::Float32, reference::DepthFormat::Unorm16})
    for (const double part : {0.98, 1.02}) {
      DeviceProfile profile = strictProfile();
      profile.depthFormat = format;
      profile.depthTolerance = 0.5;
      const raster::Face face = tests::frontFace(resolution, 0x1p-6f);
      raster::DrawList list = tests::plainList();
      addBackdrop(list, 1, 0x1p-6 / (part * reference::depthError(profile)));
      const ItemId background = raster::backgroundId(list.format);
      CHECK(verdictAt(list, face, profile, 8, 5, background) ==
            (part < 1 ? PixelVerdict::Coverage : PixelVerdict::Error));
      profile.depthTolerance = 0;
      CHECK(verdictAt(list, face, profile, 8, 5, background) == PixelVerdict::Error);
    }
}

TEST_CASE("judgeId explains a triangle far behind a boundary by coverage, not by depth", "[verdict]") {
  raster::DrawList list = tests::plainList();
  tests::addDraw(list, 1);
  reference::addQuad(list, {at(0, 0), at(8.5 + tie, 0), at(8.5 + tie, 16), at(0, 16)});
  addBackdrop(list, 2, 2);
  const raster::Face face = tests::frontFace(resolution);
  CHECK(verdictAt(list, face, coarseProfile(), 8, 5, 2) == PixelVerdict::Coverage);
  CHECK(verdictAt(list, face, coarseProfile(), 7, 5, 2) == PixelVerdict::Error);
  CHECK(verdictAt(list, face, strictProfile(), 8, 5, 2) == PixelVerdict::Error);
}

TEST_CASE("judgeId expects the first of two triangles at one depth", "[verdict]") {
  raster::DrawList list = tests::plainList();
  list.indexMaps.push_back(tests::countingMap(4, 4));
  for (const ItemId offset : {0x100u, 0x200u}) {
    tests::addDraw(list, offset, {}, 0);
    reference::addQuad(list, {at(0, 0), at(16, 0), at(16, 16), at(0, 16)});
  }
  DeviceProfile profile = strictProfile();
  profile.texelPrecision = 0.2;
  const raster::Face face = tests::frontFace(resolution);
  REQUIRE(tests::drawOne(list, face).ids[6 * resolution + 4] == 0x105);
  CHECK(verdictAt(list, face, profile, 4, 6, 0x104) == PixelVerdict::Texel);
  CHECK(verdictAt(list, face, profile, 4, 6, 0x204) == PixelVerdict::Depth);
  CHECK(verdictAt(list, face, profile, 4, 6, 0x106) == PixelVerdict::Error);
}

TEST_CASE("judgeId explains a back item ID where the triangle faces away, or may", "[verdict]") {
  constexpr ItemId front = 1, back = 2;
  const auto listOf = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    raster::DrawList list = tests::plainList();
    tests::addDraw(list, front, back);
    tests::addTriangle(list, {a, b, c});
    return list;
  };
  const raster::Face face = tests::frontFace(resolution);
  const raster::DrawList facing = listOf(at(0, 0), at(0, 16), at(16, 0));
  const raster::DrawList away = listOf(at(0, 0), at(16, 0), at(0, 16));
  REQUIRE(tests::drawOne(facing, face).ids[0] == front);
  REQUIRE(tests::drawOne(away, face).ids[0] == back);
  CHECK(verdictAt(facing, face, {}, 3, 4, back) == PixelVerdict::Error);
  CHECK(verdictAt(away, face, {}, 3, 4, front) == PixelVerdict::Error);
  // A sub-pixel high, with corners that move by one: either side may show.
  DeviceProfile moving = strictProfile();
  moving.vertexError = 0.6 / 2048 * 0x1p24;
  const double low = 8.5 + 1.0 / 256;
  for (const bool isTurned : {false, true}) {
    const raster::DrawList needle =
        isTurned ? listOf(at(2, 8.5), at(14, 8.5), at(8, low)) : listOf(at(14, 8.5), at(2, 8.5), at(8, low));
    CHECK(verdictAt(needle, face, moving, 8, 8, front) != PixelVerdict::Error);
    CHECK(verdictAt(needle, face, moving, 8, 8, back) != PixelVerdict::Error);
    CHECK(verdictAt(needle, face, moving, 8, 8, 3) == PixelVerdict::Error);
    CHECK(verdictAt(needle, face, strictProfile(), 8, 8, isTurned ? front : back) == PixelVerdict::Error);
  }
}

TEST_CASE("judgeId opens and fills a hole up to the texel precision from its border", "[verdict]") {
  // Texels of 4 x 2 pixels in front of a backdrop. Of columns 1 and 2, the second one is open; the samples of pixels 7
  // and 8 lie an eighth of a texel from the border between them.
  raster::DrawList list = tests::plainList();
  list.indexMaps.push_back({4, 1, {0, 1, raster::holeTexel, 3}});
  tests::addDraw(list, 0x100, {}, 0);
  reference::addQuad(list, {at(0, 0), at(16, 0), at(16, 16), at(0, 16)});
  addBackdrop(list, 0x200, 2);
  const raster::Face face = tests::frontFace(resolution);
  const std::vector<ItemId> ids = tests::drawOne(list, face).ids;
  REQUIRE((ids[7] == 0x101 && ids[8] == 0x200));
  for (const double precision : {0.124, 0.126}) {
    DeviceProfile profile = strictProfile();
    profile.texelPrecision = precision;
    const bool isWithin = precision > 0.125;
    CHECK((verdictAt(list, face, profile, 7, 0, 0x200) != PixelVerdict::Error) == isWithin);
    CHECK((verdictAt(list, face, profile, 8, 0, 0x101) != PixelVerdict::Error) == isWithin);
    CHECK(verdictAt(list, face, profile, 6, 0, 0x200) == PixelVerdict::Error);
    CHECK(verdictAt(list, face, profile, 9, 0, 0x101) == PixelVerdict::Error);
    for (const int column : {6, 7, 8, 9})
      CHECK(verdictAt(list, face, profile, column, 0, raster::backgroundId(list.format)) == PixelVerdict::Error);
    // A hole has no item ID.
    CHECK(verdictAt(list, face, profile, 8, 0, 0xff) == PixelVerdict::Error);
  }
}

TEST_CASE("judgeId sees no triangle that every device culls, and excuses one that may flip", "[verdict]") {
  constexpr ItemId culled = 1, behind = 2;
  const auto listOf = [&](raster::Cull cull, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    raster::DrawList list = tests::plainList();
    tests::addDraw(list, culled);
    list.draws.back().cull = cull;
    tests::addTriangle(list, {a, b, c});
    addBackdrop(list, behind, 2);
    return list;
  };
  const raster::Face face = tests::frontFace(resolution);
  for (const raster::Cull cull : {raster::Cull::Front, raster::Cull::Back}) {
    const raster::DrawList facing = listOf(cull, at(0, 0), at(0, 16), at(16, 0));
    const bool isCulled = cull == raster::Cull::Front;
    REQUIRE(tests::drawOne(facing, face).ids[0] == (isCulled ? behind : culled));
    CHECK(verdictAt(facing, face, {}, 3, 4, isCulled ? culled : behind) == PixelVerdict::Error);
  }
  // A sub-pixel high, with corners that move by one: it may turn either side to the eye.
  DeviceProfile moving = strictProfile();
  moving.vertexError = 0.6 / 2048 * 0x1p24;
  const double low = 8.5 + 1.0 / 256;
  const raster::DrawList needle = listOf(raster::Cull::Back, at(2, 8.5), at(14, 8.5), at(8, low));
  for (const ItemId id : {culled, behind}) CHECK(verdictAt(needle, face, moving, 8, 8, id) != PixelVerdict::Error);
  CHECK(verdictAt(needle, face, strictProfile(), 8, 8, culled) == PixelVerdict::Error);
}

TEST_CASE("judgeId lets a fold move off a sample, and no sheet across it", "[verdict]") {
  // Two triangles that share an edge which may move to the sample: on one side of it, or on both.
  const glm::vec3 top = at(8.5 + tie, 0), bottom = at(8.5 + tie, 16);
  for (const bool isFolded : {true, false}) {
    raster::DrawList list = tests::plainList();
    tests::addDraw(list, 1);
    tests::addTriangle(list, {top, bottom, at(1, 8)});
    tests::addTriangle(list, {bottom, top, at(isFolded ? 2 : 15, 8)});
    const raster::Face face = tests::frontFace(resolution);
    const ItemId background = raster::backgroundId(list.format);
    REQUIRE(tests::drawOne(list, face).ids[8 * resolution + 8] == 1);
    CHECK(verdictAt(list, face, coarseProfile(), 8, 8, background) ==
          (isFolded ? PixelVerdict::Coverage : PixelVerdict::Error));
    CHECK(verdictAt(list, face, coarseProfile(), 7, 8, background) == PixelVerdict::Error);
  }
}

TEST_CASE("judgeId joins triangles only at edges with bit-equal ends", "[verdict]") {
  const auto face = tests::frontFace(resolution);
  for (const int moved : {-1, 0, 1, 2}) {
    const glm::vec3 top = at(8.5 + tie, 1), bottom = at(8.5 + tie, 15);
    glm::vec3 otherTop = top;
    if (moved >= 0) otherTop[moved] = std::nextafter(otherTop[moved], 2.0f);
    raster::DrawList list = tests::plainList();
    tests::addDraw(list, 1);
    tests::addTriangle(list, {top, bottom, at(1, 8)});
    tests::addTriangle(list, {bottom, otherTop, at(15, 8)});
    INFO("coordinate " << moved);
    CHECK(verdictAt(list, face, coarseProfile(), 8, 8, raster::backgroundId(list.format)) ==
          (moved < 0 ? PixelVerdict::Error : PixelVerdict::Coverage));
  }
}

TEST_CASE("judgeId hides what lies behind the deepest point of a sheet within the reach", "[verdict]") {
  // A roof whose ridge, at 1/w = 1, lies 8 sub-pixels beside the sample; on the sample's side 1/w falls to 1/4 over the
  // 2048 sub-pixels to its end. The reach of 8 takes the sample to 16 sub-pixels from the ridge.
  const double deepest = 1 - 16.0 / 2048 * 0.75;
  for (const double inverse : {deepest + 0.0002, deepest - 0.0002}) {
    raster::DrawList list = tests::plainList();
    tests::addDraw(list, 1);
    const glm::vec3 top = at(8.5 + tie, 0.5), bottom = at(8.5 + tie, 16.5);
    tests::addTriangle(list, {top, bottom, at(0.5 + tie, 8.5, 4)});
    tests::addTriangle(list, {bottom, top, at(16.5 + tie, 8.5, 4)});
    addBackdrop(list, 2, 1 / inverse);
    INFO("1/w " << inverse);
    CHECK(verdictAt(list, tests::frontFace(resolution), coarseProfile(), 8, 8, 2) ==
          (inverse > deepest ? PixelVerdict::Depth : PixelVerdict::Error));
  }
}

TEST_CASE("judgeId lets a flipping triangle cover the other side of a fixed edge", "[verdict]") {
  // The eye lies far behind, so that the near corner, at depth 1, is off by a hundred times what the far edge, at depth
  // 1000, is off by: it may move by some 12 sub-pixels from 2 below the edge, which stays.
  raster::Face face = tests::frontFace(resolution);
  face.eye = {0, 0, -100};
  constexpr double subPixel = 1.0 / 256;
  const auto triangleBelow = [&](double height) {
    raster::DrawList list = tests::plainList();
    tests::addDraw(list, 1);
    const double edge = 15.5 + subPixel;
    tests::addTriangle(list, {at(4, edge, 1000), at(12, edge, 1000), at(8.5, edge + height * subPixel, 1)});
    for (glm::vec3& position : list.positions) position += face.eye;
    return list;
  };
  DeviceProfile profile = strictProfile();
  profile.vertexError = 0x1p-15 * 0x1p24;
  CHECK(verdictAt(triangleBelow(2), face, profile, 8, 15, 1) == PixelVerdict::Coverage);
  CHECK(verdictAt(triangleBelow(60), face, profile, 8, 15, 1) == PixelVerdict::Error);
}
