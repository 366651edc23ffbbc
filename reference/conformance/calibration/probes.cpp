#include "reference/conformance/calibration/probes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/verdict/device_profile.h"

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
glm::vec3 cornerPoint(const Picture& picture, std::size_t pixel, const glm::ivec2& corner, double w) {
  const auto side = static_cast<std::size_t>(picture.resolution);
  const glm::dvec2 sample(static_cast<double>(pixel % side) + 0.5, static_cast<double>(pixel / side) + 0.5);
  return picture.point(sample + glm::dvec2(corner) / static_cast<double>(pixelUnits), w);
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
  ProbeSheet<CoverageProbe> sheet;
  Picture picture(16);
  addDraw(picture, 1);
  for (std::size_t pixel = 0; pixel < 256; ++pixel) {
    const Corners corners = makeCorners();
    const auto point = [&](std::size_t k) { return cornerPoint(picture, pixel, corners[k], 1); };
    addTriangle(picture, {point(0), point(1), point(2)});
    sheet.pixels.push_back({corners});
  }
  sheet.vector = makeVector(name, catches, picture);
  return sheet;
}

// --- texels ---

/// A triangle whose corners are given in sixteenths of a pixel from the sample, and their w.
struct TexelTriangle {
  std::array<glm::ivec2, 3> corners;
  glm::dvec3 w;

  /// Weights of the corners' coordinates at the sample.
  glm::dvec3 weights() const {
    const auto cross = [&](std::size_t i, std::size_t j) {
      return static_cast<double>(corners[i].x * corners[j].y - corners[i].y * corners[j].x);
    };
    const glm::dvec3 overW = glm::dvec3(cross(1, 2), cross(2, 0), cross(0, 1)) / w;
    return overW / (overW.x + overW.y + overW.z);
  }

  /// w at the sample over the w of the nearest corner.
  double depthRatio() const { return glm::dot(weights(), w) / std::min({w.x, w.y, w.z}); }
};

/// The coordinates of a triangle's corners, and the texel border that the sample's coordinate is close to.
struct BorderCoordinates {
  int border;
  glm::vec3 corners;  ///< u or v
};

TexelProbe texelProbe(const TexelTriangle& triangle, int texels, const BorderCoordinates& coordinates) {
  const glm::dvec3 corners(coordinates.corners);
  const double offset = texels * glm::dot(triangle.weights(), corners) - coordinates.border;
  // The offset is 0 or much larger than its rounding here, and a coordinate on the border belongs to the texel above.
  constexpr double roundoff = 0x1p-36;
  const double largest = std::max({std::abs(corners.x), std::abs(corners.y), std::abs(corners.z)});
  return {coordinates.border, std::abs(offset) < roundoff ? 0 : std::abs(offset), offset > -roundoff,
          0x1p-24 * texels * largest * triangle.depthRatio()};
}

/// Half of the pixels of each row test u, half test v, in index maps of `texels` texels.
/// `makeCoordinates(row, isAbove, random)` chooses their coordinates; every other pixel lies above its border.
template <typename MakeCoordinates>
ProbeSheet<TexelProbe> texelSheet(const std::string& name, const TexelTriangle& triangle, int texels,
                                  const MakeCoordinates& makeCoordinates) {
  constexpr int resolution = 32;
  std::mt19937 random(32);
  ProbeSheet<TexelProbe> sheet;
  sheet.pixels.resize(resolution * resolution);
  Picture picture(resolution);
  picture.indexMaps = {countingMap(texels, 1), countingMap(1, texels)};
  for (const bool isU : {true, false}) {
    addDraw(picture, 0, {}, isU ? 0 : 1);
    for (int row = 0; row < resolution; ++row)
      for (int column = isU ? 0 : resolution / 2; column < (isU ? resolution / 2 : resolution); ++column) {
        const BorderCoordinates coordinates = makeCoordinates(row, column % 2 == 0, random);
        const auto texcoord = [&](int k) {
          return isU ? glm::vec2(coordinates.corners[k], 0.5f) : glm::vec2(0.5f, coordinates.corners[k]);
        };
        const auto pixel = static_cast<std::size_t>(row * resolution + column);
        const auto point = [&](int k) {
          return cornerPoint(picture, pixel, onGrid(triangle.corners[static_cast<std::size_t>(k)]), triangle.w[k]);
        };
        addTriangle(picture, {point(0), point(1), point(2)}, {texcoord(0), texcoord(1), texcoord(2)});
        sheet.pixels[pixel] = texelProbe(triangle, texels, coordinates);
      }
  }
  sheet.vector = makeVector(name, "errors of texture coordinates", picture);
  return sheet;
}

/// Each row has a distance: 1/4, 3/16, 1/8, 3/32, ... of a texel.
double distanceOf(int row) { return std::ldexp(row % 2 == 0 ? 1 : 0.75, -2 - row / 2); }

/// Small coordinates, so that a rounding is at most a fourteenth of the distance. Between the corners they differ by
/// `slope` texels, whose average at the sample is 0.
ProbeSheet<TexelProbe> smallCoordinates(const std::string& name, const glm::dvec3& w, const glm::dvec3& slope) {
  constexpr int texels = 1024;
  // Their centre is the sample: each corner has a weight of a third.
  const TexelTriangle triangle{{{{-6, -4}, {0, 6}, {6, -2}}}, w};
  return texelSheet(name, triangle, texels, [&](int row, bool isAbove, std::mt19937& random) {
    const double distance = distanceOf(row);
    // So small that errors of w move the coordinate by a small part of the distance.
    const double steepness = std::min(1.0, 8192 * distance);
    const int first = 1 + static_cast<int>(std::ceil(8 * steepness));
    const int border = between(random, first, 2 * first);
    const double position = border + (isAbove ? distance : -distance);
    return BorderCoordinates{border, glm::vec3((position + steepness * slope) / static_cast<double>(texels))};
  });
}

/// Coordinates in the upper half of the index map, at distances from 256 roundings to less than one. The coordinate at
/// corner k is that of the sample times 1 + slope[k].
ProbeSheet<TexelProbe> largeCoordinates(const std::string& name, const TexelTriangle& triangle, int texels,
                                        const glm::dvec3& slope) {
  return texelSheet(name, triangle, texels, [&](int row, bool isAbove, std::mt19937& random) {
    const int border = between(random, texels / 2, texels * 3 / 4);
    const double roundings = 1024 * distanceOf(row);
    const double distance = std::min(0.25, roundings * 0x1p-24 * border * triangle.depthRatio());
    const double position = (border + (isAbove ? distance : -distance)) / texels;
    return BorderCoordinates{border, glm::vec3(position * (1.0 + slope))};
  });
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
  Picture picture(resolution, nearDistance);
  for (const raster::ItemId id : {1u, 2u}) {
    addDraw(picture, id);
    for (std::size_t pixel = 0; pixel < pairs.size(); ++pixel) {
      const raster::ItemId nearer = pixel % 2 == 0 ? 1 : 2;
      const glm::dvec3& w = id == nearer ? pairs[pixel].nearer : pairs[pixel].farther;
      const auto point = [&](int k) { return cornerPoint(picture, pixel, corners[static_cast<std::size_t>(k)], w[k]); };
      addTriangle(picture, {point(0), point(1), point(2)});
      if (id == 1) sheet.pixels.push_back({pairs[pixel].step, nearer});
    }
  }
  sheet.vector = makeVector(name, "the resolution of the depth buffer", picture);
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
  // A third each: the sums of slopes, and of slopes/w, are zero.
  const glm::dvec3 flat(1), sloping(1, 2, 4);
  probes.texels = {smallCoordinates("texels-constant", flat, {0, 0, 0}),
                   smallCoordinates("texels-linear", flat, {-2, 1, 1}),
                   smallCoordinates("texels-perspective", sloping, {1, 2, -8})};
  // A narrow triangle whose sample has weights of about a half and two quarters, and one that is seen at a grazing
  // angle: w at its sample is 15 times that of its nearest corner.
  const TexelTriangle narrow{{{{-7, -7}, {7, 6}, {6, 7}}}, flat};
  const TexelTriangle grazing{{{{-7, -7}, {7, -6}, {-6, 7}}}, {1, 1024, 1024}};
  const auto slopeOf = [](const TexelTriangle& triangle, double nearest) {
    const double weight = triangle.weights().x;
    return glm::dvec3(nearest, glm::dvec2(-nearest * weight / (1 - weight)));
  };
  probes.interpolation = {
      largeCoordinates("interpolation-constant", narrow, 4096, glm::dvec3(0.0)),
      largeCoordinates("interpolation-linear", narrow, 4096, slopeOf(narrow, 1.0 / 64)),
      largeCoordinates("interpolation-grazing", grazing, 256, glm::dvec3(0.0)),
      largeCoordinates("interpolation-perspective", grazing, 256, slopeOf(grazing, -1.0 / 256)),
  };
  probes.depths = {formatSteps(), fineSteps()};
  return probes;
}

std::vector<TestVector> vectorsOf(const ProbingSet& probes) {
  std::vector<TestVector> vectors;
  for (const auto& sheet : probes.coverage) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.texels) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.interpolation) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.depths) vectors.push_back(sheet.vector);
  return vectors;
}

}  // namespace hemitex::reference
