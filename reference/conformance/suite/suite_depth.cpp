/// Which of several triangles is visible at a sample: the one of larger 1/w, and on an exact tie the earlier one.
#include <cmath>
#include <random>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

/// A light in the plane of a ceiling, drawn before or after it, both of constant depth but made of different triangles.
TestVector coplanarFlat(const std::string& name, bool lightFirst) {
  // A depth whose inverse binary arithmetic cannot hold: 1/w is rounded differently in different triangles.
  constexpr double w = 0.3f;
  Picture picture(32, 0.05f);
  for (const bool isLight : {lightFirst, !lightFirst}) {
    addDraw(picture, isLight ? 1 : 0);
    picture.addBlock(isLight ? Block{11, 9, 20, 23} : Block{2, 3, 29, 31}, w);
  }
  return makeVector(name, "ties in depth that go to the later triangle, or flicker from pixel to pixel", picture);
}

/// Four overlapping triangles of one sloped plane with exactly the same 1/w: w is 1, 2, 4, 8 at the columns 0, 16, 24,
/// 28 of 32, where 1/w = 1 - column/32.
TestVector coplanarSloped(const std::string& name, bool reversed) {
  using Corners = std::array<glm::dvec3, 3>;  // column, row, w
  const std::vector<Corners> triangles{{{{0, 0, 1}, {28, 4, 8}, {16, 32, 2}}},
                                       {{{0, 32, 1}, {24, 0, 4}, {28, 30, 8}}},
                                       {{{0, 12, 1}, {24, 8, 4}, {16, 24, 2}}},
                                       {{{16, 0, 2}, {24, 16, 4}, {0, 24, 1}}}};
  Picture picture(32);
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const std::size_t number = reversed ? triangles.size() - 1 - k : k;
    const auto corner = [&](std::size_t c) {
      const glm::dvec3& at = triangles[number][c];
      return picture.point({at.x, at.y}, at.z);
    };
    addDraw(picture, static_cast<raster::ItemId>(number));
    addTriangle(picture, {corner(0), corner(1), corner(2)});
  }
  return makeVector(name, "ties in depth on a slope that go to the later triangle", picture);
}

/// The same triangle drawn several times, from every corner: the first one stays.
TestVector sameTriangle() {
  Picture picture(32);
  const glm::vec3 a = picture.point({1, 2}, 1.3), b = picture.point({30, 5}, 7.7);
  const glm::vec3 c = picture.point({9, 31}, 3.1);
  for (raster::ItemId id = 0; id < 6; ++id) {
    addDraw(picture, id);
    if (id % 3 == 0) addTriangle(picture, {a, b, c});
    if (id % 3 == 1) addTriangle(picture, {b, c, a});
    if (id % 3 == 2) addTriangle(picture, {c, a, b});
    if (id >= 3) turnLastDraw(picture);
  }
  return makeVector("same-triangle", "less-or-equal instead of less, depth that depends on the order of corners",
                    picture);
}

/// Two triangles in each of 16 x 16 pixels, at the depths w and farther(w) of w = depthOf(pixel). The nearer one comes
/// first in every other pixel.
template <typename DepthOf, typename Farther>
TestVector depthPairs(const std::string& name, const std::string& catches, float nearDistance, const DepthOf& depthOf,
                      const Farther& farther) {
  Picture picture(16, nearDistance);
  for (int pixel = 0; pixel < 256; ++pixel)
    for (const bool isFirst : {true, false}) {
      const auto w = depthOf(pixel);
      addDraw(picture, static_cast<raster::ItemId>(2 * pixel + (isFirst ? 0 : 1)));
      picture.addPixel(pixel % 16, pixel / 16, isFirst == (pixel % 2 == 0) ? w : farther(w));
    }
  return makeVector(name, catches, picture);
}

/// Depths that differ by one binary32 number.
TestVector depthSteps() {
  return depthPairs(
      "depth-steps", "depth kept in less than binary64: the last bit of w from 1 to 65536 decides", 0.5f,
      [](int pixel) { return std::ldexp(1.0f + static_cast<float>(pixel % 16) / 16, pixel / 16); },
      [](float w) { return std::nextafter(w, 1e9f); });
}

/// A hundredth apart at depths from 0.1 to 100.
TestVector depthRange() {
  return depthPairs(
      "depth-range", "a depth buffer of 16 bits", 0.01f,
      [](int pixel) { return 0.1 + pixel * pixel * (100.0 / 65536); }, [](double w) { return 1.01 * w; });
}

/// Parallel walls in random order of depth.
TestVector depthStack() {
  std::mt19937 random(12);
  Picture picture(32);
  for (raster::ItemId id = 0; id < 64; ++id) {
    const int column = static_cast<int>(random() % 28), row = static_cast<int>(random() % 28);
    const int width = 4 + static_cast<int>(random() % 12), height = 4 + static_cast<int>(random() % 12);
    addDraw(picture, id);
    picture.addBlock({column, row, column + width, row + height}, 1 + static_cast<double>(random() % 64) / 8);
  }
  return makeVector("depth-stack", "the depth test off, reversed, or the depth buffer not cleared", picture);
}

/// Triangles that pass through each other.
TestVector crossing() {
  std::mt19937 random(7);
  Picture picture(64);
  for (raster::ItemId id = 0; id < 12; ++id) {
    std::array<glm::vec3, 3> corners;
    for (glm::vec3& corner : corners) {
      const double column = uniform(random, -8, 72), row = uniform(random, -8, 72), w = uniform(random, 1, 6);
      corner = picture.point({column, row}, w);
    }
    addDraw(picture, id);
    addTriangle(picture, {corners[0], corners[1], corners[2]});
  }
  return makeVector("crossing", "depth of a whole triangle instead of a sample, w interpolated instead of 1/w",
                    picture);
}

/// A floor nearly edge-on from w = 0.01 to 10000 under a wall: depths with a ratio of a million.
TestVector depthRatio() {
  Picture picture(32, 0.005f);
  addDraw(picture, 0);
  addQuad(picture, {glm::vec3(-9000, 0.008f, 10000), glm::vec3(9000, 0.008f, 10000), glm::vec3(0.009f, 0.008f, 0.01f),
                    glm::vec3(-0.009f, 0.008f, 0.01f)});
  for (raster::ItemId wall = 1; wall < 12; ++wall) {
    const float w = std::ldexp(0.012f, static_cast<int>(wall) * 2);
    addDraw(picture, wall);
    const float left = (static_cast<float>(wall) / 6 - 1.1f) * w, right = left + 0.14f * w;
    addQuad(picture, {glm::vec3(left, -0.9f * w, w), glm::vec3(right, -0.9f * w, w), glm::vec3(right, 0.9f * w, w),
                      glm::vec3(left, 0.9f * w, w)});
  }
  return makeVector("depth-ratio", "depth or perspective that breaks down where w spans a factor of a million",
                    picture);
}

/// 8 x 8 quads, each drawn twice with the same corners in the same order. Their depths are equal on any device, so the
/// first one stays. In three quarters of the cells another quad comes before, between or after them, a third nearer or
/// farther, which any depth format can tell.
TestVector equalDepths(const std::string& name, bool isSloped) {
  constexpr int resolution = 32, cell = 4;
  Picture picture(resolution);
  const auto add = [&](int number, double distance) {
    const double column = number % 8 * cell, row = number / 8 * cell;
    const auto corner = [&](double x, double y, double slope) {
      return picture.point({column + x, row + y}, distance * (isSloped ? 1 + slope : 1));
    };
    addDraw(picture, static_cast<raster::ItemId>(picture.draws.size()));
    addQuad(picture, {corner(0, 0, 0.03), corner(cell, 0, 0.1), corner(cell, cell, 0.07), corner(0, cell, 0.01)});
  };
  for (int number = 0; number < 64; ++number) {
    // Neighbours get all combinations, and depths whose inverses binary arithmetic cannot hold.
    const int place = (number + number / 8) % 4;
    const double w = 1 + 0.07 * number, other = number % 8 < 4 ? w / 1.5 : 1.5 * w;
    if (place == 1) add(number, other);
    add(number, w);
    if (place == 2) add(number, other);
    add(number, w);
    if (place == 3) add(number, other);
  }
  return makeVector(name, "less-or-equal instead of less: item IDs of the second of two equal triangles", picture);
}

}  // namespace

std::vector<TestVector> depthVectors() {
  return {coplanarFlat("coplanar-light-first", true),
          coplanarFlat("coplanar-ceiling-first", false),
          coplanarSloped("coplanar-slope", false),
          coplanarSloped("coplanar-slope-reversed", true),
          sameTriangle(),
          depthSteps(),
          depthRange(),
          depthStack(),
          crossing(),
          depthRatio(),
          equalDepths("equal-depths", false),
          equalDepths("equal-depths-sloped", true)};
}

}  // namespace hemitex::reference
