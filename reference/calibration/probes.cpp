#include "reference/calibration/probes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "reference/vectors/draw_list_builder.h"
#include "reference/verdict/device_profile.h"

namespace hemitex::reference {
namespace {

/// From `low` to `high`, inclusive.
int between(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

/// As between, for both coordinates. Braces evaluate from left to right, so that all compilers draw the same numbers.
glm::ivec2 pointBetween(std::mt19937& random, int low, int high) {
  return glm::ivec2{between(random, low, high), between(random, low, high)};
}

constexpr int pixelUnits = 16384;

/// Corners relative to a sample, in units.
using Corners = std::array<glm::ivec2, 3>;

/// A corner that all snappings put on the same point of the coarsest grid; `point` is in sixteenths of a pixel.
glm::ivec2 onGrid(const glm::ivec2& point) { return pixelUnits / 16 * point + 1; }

/// A corner of a pixel's triangle at depth w.
glm::vec3 cornerPoint(int resolution, std::size_t pixel, const glm::ivec2& corner, double w) {
  const auto side = static_cast<std::size_t>(resolution);
  const glm::dvec2 sample(static_cast<double>(pixel % side) + 0.5, static_cast<double>(pixel / side) + 0.5);
  return pixelPoint(resolution, sample + glm::dvec2(corner) / static_cast<double>(pixelUnits), w);
}

TestVector makeProbe(std::string name, std::string catches, raster::DrawList list, const raster::Face& face) {
  TestVector vector;
  vector.name = std::move(name);
  vector.catches = std::move(catches);
  vector.list = std::move(list);
  vector.faces = {{"front", face, "front.u32", {}}};
  return vector;
}

// --- coverage ---

/// In squared pixels.
double areaOf(const Corners& corners) {
  const glm::dvec2 p(corners[1] - corners[0]), q(corners[2] - corners[0]);
  return std::abs(p.x * q.y - p.y * q.x) / 2 / pixelUnits / pixelUnits;
}

/// A triangle with an edge that passes the sample at about the distance by which `bits` of sub-pixel precision move its
/// ends.
Corners nearEdge(std::mt19937& random, int bits) {
  constexpr int most = 7 * pixelUnits / 32;
  const int step = pixelUnits >> bits;
  for (;;) {
    const glm::ivec2 start = 2 * pointBetween(random, -most, most) + 1;
    const glm::ivec2 nudge = 2 * (pointBetween(random, -step, step) / 2);
    const Corners corners{start, nudge - start, 2 * pointBetween(random, -most, most) + 1};
    if (areaOf(corners) > 0.03) return corners;
  }
}

/// A triangle with an edge through the sample, for all snappings.
Corners throughSample(std::mt19937& random) {
  for (;;) {
    const glm::ivec2 start = pointBetween(random, -7, 7);
    const Corners corners{onGrid(start), onGrid(-start), onGrid(pointBetween(random, -7, 7))};
    if (areaOf(corners) > 0.01) return corners;
  }
}

template <typename MakeCorners>
ProbeSheet<CoverageProbe> coverageSheet(const std::string& name, const std::string& catches,
                                        const MakeCorners& makeCorners) {
  constexpr int resolution = 16;
  ProbeSheet<CoverageProbe> sheet;
  raster::DrawList list = plainList();
  addDraw(list, 1);
  for (std::size_t pixel = 0; pixel < resolution * resolution; ++pixel) {
    const Corners corners = makeCorners();
    const auto point = [&](std::size_t k) { return cornerPoint(resolution, pixel, corners[k], 1); };
    addTriangle(list, {point(0), point(1), point(2)});
    sheet.pixels.push_back({corners});
  }
  sheet.vector = makeProbe(name, catches, std::move(list), frontFace(resolution, 0.5f));
  return sheet;
}

// --- texels ---

/// The differences of coordinates between the corners of a triangle, and their w. At its centre the differences cancel.
struct Slope {
  std::string name;
  glm::ivec3 texels;
  glm::ivec3 w;
};

/// One row per distance: 1/4, 3/16, 1/8, 3/32, ... of a texel. Half of its pixels test u, half test v; of each half,
/// every other pixel lies above the border. Binary32 represents all coordinates exactly.
ProbeSheet<TexelProbe> texelSheet(const Slope& slope) {
  constexpr int resolution = 32, texels = 1024;
  // Their centre is the sample: each corner has a weight of a third.
  const Corners corners{onGrid({-6, -4}), onGrid({0, 6}), onGrid({6, -2})};
  std::mt19937 random(32);
  ProbeSheet<TexelProbe> sheet;
  sheet.pixels.resize(resolution * resolution);
  raster::DrawList list = plainList();
  list.indexMaps = {countingMap(texels, 1), countingMap(1, texels)};
  for (const bool isU : {true, false}) {
    addDraw(list, 0, {}, isU ? 0 : 1);
    for (int row = 0; row < resolution; ++row)
      for (int column = isU ? 0 : resolution / 2; column < (isU ? resolution / 2 : resolution); ++column) {
        const int octave = 2 + row / 2;
        const double distance = std::ldexp(row % 2 == 0 ? 1 : 0.75, -octave);
        // 24 bits represent multiples of distance/3 up to here; the slope takes at most 8 texels on either side.
        const int last = std::min(texels, 1 << (22 - octave)) - 9;
        const TexelProbe probe{between(random, std::max(9, last / 2), last), distance, column % 2 == 0};
        // So small that errors of w move the coordinate by a small part of the distance.
        const double steepness = std::min(1.0, std::ldexp(1, 11 - octave));
        const auto texcoord = [&](int k) {
          const double position = probe.border + (probe.isAbove ? distance : -distance) + steepness * slope.texels[k];
          const auto coordinate = static_cast<float>(position / texels);
          return isU ? glm::vec2(coordinate, 0.5f) : glm::vec2(0.5f, coordinate);
        };
        const auto pixel = static_cast<std::size_t>(row * resolution + column);
        const auto point = [&](int k) {
          return cornerPoint(resolution, pixel, corners[static_cast<std::size_t>(k)], slope.w[k]);
        };
        addTriangle(list, {point(0), point(1), point(2)}, {texcoord(0), texcoord(1), texcoord(2)});
        sheet.pixels[pixel] = probe;
      }
  }
  sheet.vector =
      makeProbe("texels-" + slope.name, "errors of texture coordinates", std::move(list), frontFace(resolution, 0.5f));
  return sheet;
}

// --- depths ---

/// A pair of triangles per pixel: `depths` holds, for each pixel, the w of the nearer one's corners and of the
/// farther's.
struct DepthPair {
  DepthStep step;
  glm::dvec3 nearer, farther;
};

ProbeSheet<DepthProbe> depthSheet(const std::string& name, int resolution, float nearDistance,
                                  const std::vector<DepthPair>& pairs) {
  const Corners corners{onGrid({-6, 1}), onGrid({0, -7}), onGrid({6, 1})};  // the sample's weights are 7/16, 2/16, 7/16
  ProbeSheet<DepthProbe> sheet;
  raster::DrawList list = plainList();
  for (const raster::ItemId id : {1u, 2u}) {
    addDraw(list, id);
    for (std::size_t pixel = 0; pixel < pairs.size(); ++pixel) {
      const raster::ItemId nearer = pixel % 2 == 0 ? 1 : 2;
      const glm::dvec3& w = id == nearer ? pairs[pixel].nearer : pairs[pixel].farther;
      const auto point = [&](int k) {
        return cornerPoint(resolution, pixel, corners[static_cast<std::size_t>(k)], w[k]);
      };
      addTriangle(list, {point(0), point(1), point(2)});
      if (id == 1) sheet.pixels.push_back({pairs[pixel].step, nearer});
    }
  }
  sheet.vector =
      makeProbe(name, "the resolution of the depth buffer", std::move(list), frontFace(resolution, nearDistance));
  return sheet;
}

/// The largest difference of two stored depths that a device of a format may not resolve.
double confusable(DepthFormat format) {
  DeviceProfile profile;
  profile.depthFormat = format;
  return 2 * depthError(profile);
}

/// Depths 1 - n/w close to 1, where binary32 allows fine steps of w. Their difference is an eighth above the limit of a
/// format.
ProbeSheet<DepthProbe> formatSteps() {
  constexpr int resolution = 32;
  constexpr double n = 0.25;
  std::mt19937 random(24);
  std::vector<DepthPair> pairs;
  for (int row = 0; row < resolution; ++row) {
    const DepthStep step = row < 8 ? DepthStep::Unorm16 : row < 16 ? DepthStep::Float32 : DepthStep::Unorm24;
    const DepthFormat format = row < 8 ? DepthFormat::Unorm16 : row < 16 ? DepthFormat::Float32 : DepthFormat::Unorm24;
    for (int column = 0; column < resolution; ++column) {
      const double w = 64 + between(random, 0, 1 << 20) * 0x1p-14;
      const double behind = n / (n / w - 1.125 * confusable(format));
      pairs.push_back({step, glm::dvec3(w), glm::dvec3(behind)});
    }
  }
  return depthSheet("depth-formats", resolution, static_cast<float>(n), pairs);
}

/// Depths just behind the near plane with differences of a quarter of 2^-24. One corner of the nearer triangle is a
/// binary32 step nearer than the others and has a weight of an eighth. There a float32 buffer is much finer than an
/// integer buffer.
ProbeSheet<DepthProbe> fineSteps() {
  constexpr int resolution = 16;
  std::mt19937 random(16);
  std::vector<DepthPair> pairs;
  for (int pixel = 0; pixel < resolution * resolution; ++pixel) {
    const double w = 1 + between(random, 1 << 6, 1 << 13) * 0x1p-23;
    pairs.push_back({DepthStep::Fine, {w, w - 0x1p-23, w}, glm::dvec3(w)});
  }
  return depthSheet("depth-fine", resolution, 1, pairs);
}

}  // namespace

ProbingSet makeProbes() {
  ProbingSet probes;
  std::mt19937 random(4);
  for (int bits = 4; bits <= 12; ++bits)
    probes.coverage.push_back(
        coverageSheet("snapping-" + std::to_string(bits),
                      "sub-pixel bits and rounding of vertices, most of all of " + std::to_string(bits) + " bits",
                      [&] { return nearEdge(random, bits); }));
  probes.coverage.push_back(
      coverageSheet("edge-rule", "which samples on edges are covered", [&] { return throughSample(random); }));
  // A third each: the sums of texels, and of texels/w, are zero.
  for (const Slope& slope : {Slope{"constant", {0, 0, 0}, {1, 1, 1}}, Slope{"linear", {-2, 1, 1}, {1, 1, 1}},
                             Slope{"perspective", {1, 2, -8}, {1, 2, 4}}})
    probes.texels.push_back(texelSheet(slope));
  probes.depths = {formatSteps(), fineSteps()};
  return probes;
}

std::vector<TestVector> vectorsOf(const ProbingSet& probes) {
  std::vector<TestVector> vectors;
  for (const auto& sheet : probes.coverage) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.texels) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.depths) vectors.push_back(sheet.vector);
  return vectors;
}

}  // namespace hemitex::reference
