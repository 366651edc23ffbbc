// The bounds of device triangles against closed forms, tested just inside and just outside of each bound.
#include "reference/conformance/verdict/triangle_bounds.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using reference::DeviceProfile;
using reference::DeviceTriangle;
using reference::EdgeRule;
using reference::SnapRounding;

namespace {

constexpr int faceResolution = 16;
constexpr double halfView = 128 * faceResolution;  // a unit of x/w, in sub-pixels

std::vector<DeviceTriangle> placed(const std::vector<glm::vec3>& corners, const raster::Face& face,
                                   const DeviceProfile& profile, bool loose = false) {
  raster::DrawList list = tests::plainList();
  tests::addDraw(list, 1);
  tests::addTriangle(list, {corners[0], corners[1], corners[2]}, {{0, 0}, {1, 0}, {0, 1}});
  return placeTriangles(list, face, profile, loose, [](const DeviceTriangle&) { return true; });
}

/// A point at depth 1 whose picture is at (x, y) sub-pixels from the middle.
glm::vec3 inView(double x, double y) { return {static_cast<float>(x / halfView), static_cast<float>(y / halfView), 1}; }

/// A device whose vertex stage is off by `roundoff`, relative to the sums of sizes.
DeviceProfile withRoundoff(double roundoff, int subpixelBits = 8) {
  DeviceProfile profile;
  profile.vertexError = roundoff * 0x1p24;
  profile.subpixelBits = subpixelBits;
  return profile;
}

}  // namespace

TEST_CASE("placeTriangles lets a vertex reach as far as its device may snap it", "[verdict]") {
  struct Case {
    int bits;
    SnapRounding rounding;
    double position, error, reach;  // in sub-pixels
  };
  constexpr auto nearest = SnapRounding::Nearest, truncate = SnapRounding::Truncate, none = SnapRounding::None;
  const std::vector<Case> cases{
      {8, nearest, 0.25, 0, 0},     {8, nearest, 0.5, 0, 1},    // a tie, ours at 0
      {8, nearest, 1.5, 0, 1},                                  // a tie, ours at 2
      {8, nearest, 0.25, 0.24, 0},                              // up to 0.49
      {8, nearest, 0.25, 0.26, 1},                              // up to 0.51
      {8, nearest, 0.75, 0.24, 0},                              // down to 0.51
      {8, nearest, 0.75, 0.26, 1},                              // down to 0.49
      {8, truncate, 0.25, 0, 0},    {8, truncate, 0.75, 0, 1},  // ours at 1
      {8, truncate, 0.25, 0.24, 0},                             // down to 0.01
      {8, truncate, 0.25, 0.26, 1},                             // down to -0.01
      {8, truncate, 0.4, 0.2, 0},                               // up to 0.6
      {4, nearest, 7, 0, 7},                                    // units of 16 sub-pixels
      {4, nearest, 9, 0, 7},        {4, nearest, 8, 0, 8},     {4, truncate, 15, 0, 15},
      {12, nearest, 0.25, 0, 0.25}, {4, none, 0.25, 0, 0.25},  {4, none, 0.75, 0, 0.25},  // ours at 1
  };
  for (const Case& each : cases)
    for (const int axis : {0, 1}) {
      // At the middle of the view, at depth 1, the error is the roundoff alone: 2048 sub-pixels of it.
      DeviceProfile profile = withRoundoff(each.error / halfView, each.bits);
      profile.snapRounding = each.rounding;
      const glm::vec3 corner = axis == 0 ? inView(each.position, 0) : inView(0, each.position);
      const auto triangles = placed({corner, {1, -1, 1}, {-1, -1, 1}}, tests::frontFace(faceResolution), profile);
      INFO(each.bits << " bits, at " << each.position << " with error " << each.error << ", axis " << axis);
      REQUIRE(triangles.size() == 1);
      CHECK(triangles[0].reaches[0][axis] == each.reach);
    }
}

TEST_CASE("placeTriangles lets a vertex reach as far as the roundings of its sums", "[verdict]") {
  // All vertices are seen at q = (1, 0). With the sums of sizes s of the picture and t of the depth, relative to w, and
  // a roundoff of r: x and y are off by r s, w by a factor within 1 - r t and 1 + r t, hence x/w by
  // (r s + r t |x/w|) / (1 - r t); the division and the viewport add r (|x/w| + 1).
  struct Case {
    glm::vec3 eye, corner;
    double picture, depth;
  };
  const std::vector<Case> cases{
      {{0, 0, 0}, {1, 0, 1}, 1, 1},
      {{3, 0, 0}, {4, 0, 1}, 7, 1},  // |4| + |3|
      {{0, 3, 0}, {1, 3, 1}, 6, 1},  // the larger of 1 and |3| + |3|
      {{0, 0, 63}, {1, 0, 64}, 1, 127},
  };
  const double roundoff = 0x1p-8;
  for (const Case& each : cases) {
    raster::Face face = tests::frontFace(faceResolution);
    face.eye = each.eye;
    const auto triangles = placed({each.corner, each.eye + glm::vec3(-1, -1, 1), each.eye + glm::vec3(-1, 1, 1)}, face,
                                  withRoundoff(roundoff, 12));
    const auto error = [&](double q) {
      return halfView * roundoff * ((each.picture + each.depth * q) / (1 - roundoff * each.depth) + (q + 1));
    };
    INFO("eye " << each.eye.x << ' ' << each.eye.y << ' ' << each.eye.z);
    REQUIRE(triangles.size() == 1);
    // Snapping to sixteenths adds up to half of one.
    CHECK(triangles[0].reaches[0].x == Approx(error(1)).margin(1.0 / 32));
    CHECK(triangles[0].reaches[0].y == Approx(error(0)).margin(1.0 / 32));
  }
}

TEST_CASE("placeTriangles gives a triangle the largest reach and depth error of its vertices", "[verdict]") {
  // Sums of sizes 3, 4 and 6 at depths 1, 2 and 4: relative to the depth the first is the largest. Of the positions the
  // one on a tie may move.
  raster::Face face = tests::frontFace(faceResolution);
  face.eye = {0, 0, 1};
  std::vector<glm::vec3> corners{{0.5f / 2048, 0, 2}, {1, -1, 3}, {-1, -1, 5}};
  for (int turn = 0; turn < 3; ++turn) {
    const auto triangles = placed(corners, face, withRoundoff(0x1p-20));
    INFO("turn " << turn);
    REQUIRE(triangles.size() == 1);
    CHECK(triangles[0].depthSlack == 3 * 0x1p-20);
    CHECK(triangles[0].reach == glm::dvec2(1, 0));
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST_CASE("placeTriangles lets a triangle flip when its legs are short for its reach", "[verdict]") {
  // Legs of a and h along the axes whose corners move by d and e along x and y: the doubled area is a h, and changes by
  // at most 2 (a e + h d) + 4 d e.
  struct Case {
    double width, height;
    bool movesX, movesY, mayFlip;
  };
  const std::vector<Case> cases{
      {6, 4, true, true, true},      // 24 of at most 24
      {7, 4, true, true, false},     // 28 of at most 26
      {2, 100, true, false, true},   // 200 of at most 200
      {3, 100, true, false, false},  // 300 of at most 200
      {100, 2, true, false, false},  // 200 of at most 4
      {100, 2, false, true, true},  {100, 3, false, true, false}, {1, 1, false, false, false},
  };
  for (const Case& each : cases)
    for (const double direction : {1.0, -1.0}) {
      // Truncated a quarter below a whole number, a corner may move by one.
      DeviceProfile profile = withRoundoff(0);
      profile.snapRounding = SnapRounding::Truncate;
      const double x = each.movesX ? -0.25 : 0, y = each.movesY ? -0.25 : 0;
      const auto triangles = placed({inView(x, y), inView(x + each.width, y), inView(x, y + direction * each.height)},
                                    tests::frontFace(faceResolution), profile);
      INFO(each.width << " x " << each.height << ", direction " << direction);
      REQUIRE(triangles.size() == 1);
      CHECK(triangles[0].reach == glm::dvec2(each.movesX ? 1 : 0, each.movesY ? 1 : 0));
      CHECK(static_cast<double>(triangles[0].area) == direction * each.width * each.height);
      CHECK(triangles[0].mayFlip == each.mayFlip);
    }
}

TEST_CASE("placeTriangles finds the same facing in a mirrored view", "[verdict]") {
  raster::Face mirrored = tests::frontFace(faceResolution);
  mirrored.x = -mirrored.x;
  const std::vector<glm::vec3> front{{-1, -1, 1}, {1, 1, 1}, {1, -1, 1}}, away{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}};
  for (const raster::Face& face : {tests::frontFace(faceResolution), mirrored}) {
    CHECK_FALSE(placed(front, face, {})[0].facesAway);
    CHECK(placed(away, face, {})[0].facesAway);
  }
}

TEST_CASE("placeTriangles cuts a triangle loosely only where its errors take it out of the view", "[verdict]") {
  // A corner at (x, 0, 1) may be off by r x along x and by r along w. It may leave the view where x + r x > 1 - r: from
  // 255/257 up, with r = 1/256. At depth w it may cross the near plane at n where w - r w < n.
  struct Case {
    glm::vec3 corner;
    bool isCut;
  };
  const double roundoff = 1.0 / 256;
  const std::vector<Case> cases{{{0.991f, 0, 1}, false}, {{0.993f, 0, 1}, true}, {{-0.993f, 0, 1}, true},
                                {{0, 0.991f, 1}, false}, {{0, 0.993f, 1}, true}, {{0, -0.993f, 1}, true},
                                {{0, 0, 0.503f}, false}, {{0, 0, 0.501f}, true}};
  for (const Case& each : cases) {
    const std::vector<glm::vec3> corners{each.corner, {0.25f, 0.5f, 1}, {0.5f, 0.25f, 1}};
    const raster::Face face = tests::frontFace(faceResolution, 0.5f);
    const DeviceTriangle strict = placed(corners, face, withRoundoff(roundoff)).at(0);
    const DeviceTriangle loose = placed(corners, face, withRoundoff(roundoff), true).at(0);
    INFO(each.corner.x << ' ' << each.corner.y << ' ' << each.corner.z);
    CHECK((loose.reach != strict.reach) == each.isCut);
  }
}

TEST_CASE("placeTriangles gives vertices of a loosely cut triangle the largest error and any snapping", "[verdict]") {
  // A corner leaves the view; the sums of sizes of the others are 1 and 1, its own 1.5 and 1. In the middle of the view
  // the error is that of the picture and the viewport, r (1.5 / (1 - r) + 1).
  const double roundoff = 1.0 / 256;
  const std::vector<glm::vec3> corners{{0, 0, 1}, {1.5f, 1, 1}, {1, 0, 1}};
  for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) {
    DeviceProfile profile = withRoundoff(roundoff, 6);
    profile.snapRounding = rounding;
    const DeviceTriangle loose = placed(corners, tests::frontFace(faceResolution), profile, true).at(0);
    const double ours = 0.5, device = rounding == SnapRounding::Nearest ? 2 : 4;
    const double error = halfView * roundoff * (1.5 / (1 - roundoff) + 1);
    CHECK(loose.reaches[0].x == Approx(error + ours + device));
    CHECK(loose.reaches[0].y == Approx(error + ours + device));
  }
}

TEST_CASE("placeTriangles moves the loose near plane by the error of the depth, down to a half", "[verdict]") {
  // Depths from 0.25 to 3, of which the largest counts for all.
  const std::vector<glm::vec3> corners{{0, 0, 0.25f}, {0.5f, 0.25f, 1}, {0.5f, -0.5f, 3}};
  for (const double roundoff : {1.0 / 256, 1.0 / 4}) {
    double nearest = 1;
    for (const DeviceTriangle& triangle :
         placed(corners, tests::frontFace(faceResolution, 0.5f), withRoundoff(roundoff), true))
      for (const raster::ViewVertex& vertex : triangle.vertices) nearest = std::min(nearest, vertex.w);
    CHECK(nearest == (roundoff < 0.1 ? 0.5 - 3 * roundoff : 0.25));
  }
}

TEST_CASE("regionAt bounds the triangle within its reach of a sample", "[verdict]") {
  // Over the legs of 1024 sub-pixels u runs along x and v along y from 0 to 1, at constant depth; with 1/w from 1 to
  // 1/2 along x, u/w runs from 0 to 1/2, and u = (t/2) / (1 - t/2) at t of the leg.
  for (const double x : {0.0, -0.25}) {
    // The corners are snapped to x = 0 and 1024; truncated from a quarter below, they may be one to the left.
    DeviceProfile profile = withRoundoff(0);
    profile.snapRounding = SnapRounding::Truncate;
    const glm::dvec2 sample(halfView + 256, halfView + 512);
    const double reach = x == 0 ? 0 : 1;
    const auto face = tests::frontFace(faceResolution);
    const DeviceTriangle flat = placed({inView(x, 0), inView(x + 1024, 0), inView(x, 1024)}, face, profile).at(0);
    const auto region = regionAt(flat, sample, EdgeRule::TopLeft);
    REQUIRE(region);
    const auto bound = [](double value) { return Approx(value).margin(1e-7); };
    CHECK(region->low.x == bound((256 - reach) / 1024));
    CHECK(region->high.x == bound((256 + reach) / 1024));
    CHECK(region->low.y == bound(0.5));
    CHECK(region->high.y == bound(0.5));

    const DeviceTriangle steep =
        placed({inView(x, 0), 2.0f * inView(x + 1024, 0), inView(x, 1024)}, face, profile).at(0);
    const auto slanted = regionAt(steep, sample, EdgeRule::TopLeft);
    REQUIRE(slanted);
    const double low = (256 - reach) / 1024, high = (256 + reach) / 1024;
    CHECK(slanted->nearest == bound(1 - low / 2));
    CHECK(slanted->farthest == bound(1 - high / 2));
    CHECK(slanted->low.x == bound(low / 2 / (1 - low / 2)));
    CHECK(slanted->high.x == bound(high / 2 / (1 - high / 2)));
  }
}

TEST_CASE("edgeMayPass is true within the reach of an edge, and false beyond its ends", "[verdict]") {
  // An edge along y = x / 2 from (0, 0) to (512, 256) whose ends move by one along x: the band |x - 2y| <= 1.
  DeviceProfile profile = withRoundoff(0);
  profile.snapRounding = SnapRounding::Truncate;
  const DeviceTriangle triangle =
      placed({inView(-0.25, 0), inView(511.75, 256), inView(-0.25, 256)}, tests::frontFace(faceResolution), profile)
          .at(0);
  const auto passes = [&](double x, double y) {
    return edgeMayPass(triangle, 0, glm::dvec2(halfView) + glm::dvec2(x, y), EdgeRule::TopLeft);
  };
  CHECK(passes(256, 128));
  CHECK(passes(257, 128));
  CHECK(passes(255, 128));
  CHECK_FALSE(passes(258, 128));
  CHECK_FALSE(passes(254, 128));
  CHECK(passes(513, 256));
  CHECK_FALSE(passes(514, 257));
  CHECK_FALSE(passes(-2, -1));
}
