/// Which samples a triangle covers: snapping to the sub-pixel grid, corners on samples, needles, and clipping.
#include <random>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

/// A triangle in a draw of its own, whose item ID is the draw's number; corners in pixels.
void addNumbered(Picture& picture, const std::array<glm::dvec2, 3>& corners, double w) {
  addDraw(picture, static_cast<raster::ItemId>(picture.draws.size()));
  addTriangle(picture, {picture.point(corners[0], w), picture.point(corners[1], w), picture.point(corners[2], w)});
}

/// Snapping to even, seen in one pixel for each k from 0 to 255: a corner has the fraction (k + 1/2)/256 of a pixel.
///
/// Let the sample be the origin of the snapped axis, in sub-pixels. The corner lies at d + 1/2 and snaps to the even
/// one of d and d + 1. An edge from it through the sample's neighbourhood to an opposite point cuts the pixel in two.
/// If the corner moves by one, the edge at the sample moves by a half. For even k the edge passes through the sample
/// where the corner is snapped to d, and the sample belongs to the far half; snapping to d + 1 would give it to the
/// near half. For odd k the opposite point is nudged by one: the edge passes a half behind the sample, which belongs to
/// the near half; snapping to d would move the edge onto the sample and give it to the far half.
///
/// Pixel k therefore holds 2k + 1, its far half, for even k, and 2k for odd k, and any other rounding changes it.
TestVector snapping(const std::string& name, bool isRow) {
  Picture picture(16);
  for (int k = 0; k < 256; ++k) {
    const glm::dvec2 sample(k % 16 + 0.5, k / 16 + 0.5);
    // From 0 to 255, so that the edge always slopes the same way; the corner's fraction of a pixel is the same.
    const int d = (k + 128) % 256;
    const int snapped = d + d % 2;
    const auto point = [&](double along, double across) {
      return sample + subPixel * (isRow ? glm::dvec2(across, along) : glm::dvec2(along, across));
    };
    const glm::dvec2 corner = point(d + 0.5, -96), opposite = point(k % 2 - snapped, 96);
    addNumbered(picture, {corner, opposite, point(-250, 0)}, 1);
    addNumbered(picture, {corner, opposite, point(250, 0)}, 1);
  }
  return makeVector(
      name, "truncated or half-up snapping of vertices to 1/256 pixel, or another number of sub-pixel bits", picture);
}

/// Stacked triangles whose corners lie on samples.
TestVector cornersOnSamples() {
  std::mt19937 random(16);
  Picture picture(16);
  for (int t = 0; t < 64; ++t) {
    std::array<glm::dvec2, 3> corners;
    for (glm::dvec2& corner : corners) {
      const auto column = random() % 16, row = random() % 16;
      corner = {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
    }
    addNumbered(picture, corners, 1 + t / 4096.0);
  }
  return makeVector("corners-on-samples", "a fill rule that treats corners otherwise than edges", picture);
}

/// Triangles at most two sub-pixels wide, some without any area, and up to the whole picture long. Of every four, three
/// run from sample to sample, and along slopes on which further samples lie.
TestVector needles() {
  constexpr int resolution = 64;
  std::mt19937 random(64);
  Picture picture(resolution);
  for (int t = 0; t < 192; ++t) {
    const auto below = [&](unsigned count) { return static_cast<double>(random() % count); };
    const double x = below(resolution), y = below(resolution), dx = below(9) - 4, dy = below(9) - 4, steps = below(32);
    const double aside = below(5) - 2, along = below(5) - 2;
    const glm::dvec2 nudge = t % 4 == 0 ? glm::dvec2(37, 101) * subPixel : glm::dvec2(0);
    const glm::dvec2 start = glm::dvec2(x + 0.5, y + 0.5) + nudge, end = start + steps * glm::dvec2(dx, dy);
    addNumbered(picture, {start, end, end + subPixel * glm::dvec2(aside, along)}, 1 + t / 4096.0);
  }
  return makeVector("needles", "thin triangles culled, widened, or with edge functions that lose their last bits",
                    picture);
}

/// A bent sheet whose triangles are draws numbered in order.
template <typename Point>
Picture sheet(Picture picture, int cells, const Point& point) {
  const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    addDraw(picture, static_cast<raster::ItemId>(picture.draws.size()));
    addTriangle(picture, {a, b, c});
  };
  forEachCell(cells, point, [&](const std::array<glm::vec3, 4>& p, int, int) {
    add(p[0], p[2], p[1]);
    add(p[0], p[3], p[2]);
  });
  return picture;
}

/// Covers the whole view, each corner at its own depth from 1 to 4.
TestVector perspectiveSheet() {
  std::mt19937 random(4);
  const Picture picture = sheet(Picture(64), 8, [&](int i, int j) {
    const float x = static_cast<float>(i) * 0.3f - 1.2f + uniform(random, -0.1f, 0.1f);
    const float y = static_cast<float>(j) * 0.3f - 1.2f + uniform(random, -0.1f, 0.1f);
    const float w = uniform(random, 1, 4);
    return glm::vec3(x * w, y * w, w);
  });
  return makeVector("perspective-sheet", "holes between triangles whose shared corners are projected or snapped twice",
                    picture);
}

/// Triangles of one or two pixels inside the view, whose corners lie anywhere between sub-pixels, as texels of one map.
TestVector subPixelSheet() {
  constexpr int cells = 24;
  std::mt19937 random(24);
  Picture picture(2 * cells + 4);
  addTexelSheet(picture, cells, [&](int i, int j) {
    const auto across = [&](int cell) { return 2 + 2 * cell + static_cast<double>(uniform(random, -0.6f, 0.6f)); };
    const double column = across(i), row = across(j);
    return picture.point({column, row});
  });
  return makeVector("sub-pixel-sheet", "vertices snapped to fewer than 8 sub-pixel bits", picture);
}

/// A floor half a unit under the eye that reaches from behind the eye to 6 units ahead, cut at the near plane w = 1.5.
TestVector nearPlaneSheet() {
  std::mt19937 random(15);
  const Picture picture = sheet(Picture(64, 1.5f), 9, [&](int i, int j) {
    const float x = static_cast<float>(2 * i - 9) + uniform(random, -0.5f, 0.5f);
    const float z = static_cast<float>(j - 3) + uniform(random, -0.3f, 0.3f);
    return glm::vec3(x, 0.5f, z);
  });
  return makeVector("near-plane-sheet", "holes or a ragged edge where triangles that share edges cross the near plane",
                    picture);
}

/// A wall at w = 1 that reaches a thousand times farther than the view.
TestVector guardBandSheet() {
  std::mt19937 random(8);
  const Picture picture = sheet(Picture(64), 4, [&](int i, int j) {
    // Lines close to the view's middle and far outside.
    constexpr std::array<float, 5> lines{-1000, -9, 0, 3, 1000};
    const float x = lines[static_cast<std::size_t>(i)] + uniform(random, -0.5f, 0.5f);
    const float y = lines[static_cast<std::size_t>(j)] + uniform(random, -0.5f, 0.5f);
    return glm::vec3(x, y, 1);
  });
  return makeVector("guard-band-sheet", "holes where huge triangles are cut far outside the view, or overflow",
                    picture);
}

/// A tilted sheet through the space before, beside and behind the eye: edges cross the near plane and the guard band.
TestVector frustumSheet() {
  std::mt19937 random(6);
  const Picture picture = sheet(Picture(64, 0.05f), 12, [&](int i, int j) {
    const float x = static_cast<float>(i - 6) * 0.35f + uniform(random, -0.1f, 0.1f);
    const float z = static_cast<float>(j - 4) * 0.12f + uniform(random, -0.04f, 0.04f);
    return glm::vec3(x, 0.04f + 0.01f * x - 0.2f * z, z);
  });
  return makeVector("frustum-sheet", "holes where edges cross the near plane and the guard band both", picture);
}

/// Strips that begin and end outside of the view, up to two and a half of its widths away, inside the guard band. Every
/// third sample lies exactly on an edge between two of them, and belongs to the strip above it. Where a device cuts an
/// edge at a side of the view, it snaps the new corner, moves the edge, and may give these samples to the strip below.
TestVector edgesBeyondTheView() {
  constexpr int resolution = 32;
  Picture picture(resolution);
  for (int strip = -resolution; strip <= resolution; ++strip) {
    // Slope 1/3 through the sample (0, strip); the ends lie on samples as well.
    const int left = -3 * (20 + (strip + resolution) % 7), right = 3 * (20 + (strip + resolution) % 11);
    const auto point = [&](int column, int below) {
      return picture.point({column + 0.5, strip + below + column / 3 + 0.5});
    };
    addDraw(picture, static_cast<raster::ItemId>(picture.draws.size()));
    addQuad(picture, {point(left, 0), point(right, 0), point(right, 1), point(left, 1)});
  }
  return makeVector("edges-beyond-the-view", "triangles that the device clips at the sides of the view by itself",
                    picture);
}

/// Triangles with none, one, two or three corners behind the near plane, some of them on it.
TestVector crossingTheEye() {
  std::mt19937 random(3);
  Picture picture(32, 0.25f);
  for (raster::ItemId id = 0; id < 48; ++id) {
    const float middleX = uniform(random, -1, 1), middleY = uniform(random, -1, 1);
    std::array<glm::vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const float x = middleX + uniform(random, -0.3f, 0.3f), y = middleY + uniform(random, -0.3f, 0.3f);
      const float behind = uniform(random, -1, 0.25f), ahead = uniform(random, 0.25f, 2);
      const bool isOnPlane = id % 8 == k;
      corners[k] = {x, y, isOnPlane ? 0.25f : k < id % 4 ? behind : ahead};
    }
    addDraw(picture, id);
    addTriangle(picture, {corners[0], corners[1], corners[2]});
  }
  return makeVector("behind-the-eye", "corners behind the eye projected through it, triangles dropped whole, w = 0",
                    picture);
}

}  // namespace

std::vector<TestVector> coverageVectors() {
  return {snapping("snapping-columns", false),
          snapping("snapping-rows", true),
          cornersOnSamples(),
          needles(),
          perspectiveSheet(),
          nearPlaneSheet(),
          guardBandSheet(),
          frustumSheet(),
          crossingTheEye(),
          edgesBeyondTheView(),
          subPixelSheet()};
}

}  // namespace hemitex::reference
