#include "reference/conformance/calibration/probes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "reference/conformance/suite/vector_suite.h"
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

constexpr int pixelUnits = 1 << exactBits;
constexpr int coarseUnit = 16;  // of the corners for coarseBits, in units

/// Corners relative to a sample, in units.
using Corners = std::array<glm::ivec2, 3>;

/// A corner that all snappings put on the same point of the coarsest grid, if they are coarser than twice the offset;
/// `point` is in sixteenths of a pixel.
glm::ivec2 onGrid(const glm::ivec2& point, int offset = coarseUnit) { return pixelUnits / 16 * point + offset; }

/// A corner of a pixel's triangle at depth w.
glm::vec3 cornerPoint(const Picture& picture, std::size_t pixel, const glm::ivec2& corner, double w) {
  const auto side = static_cast<std::size_t>(picture.resolution);
  const glm::dvec2 sample(static_cast<double>(pixel % side) + 0.5, static_cast<double>(pixel / side) + 0.5);
  return picture.point(sample + glm::dvec2(corner) / static_cast<double>(pixelUnits), w);
}

// --- coverage ---

/// In squared pixels; negative for the other winding.
double signedArea(const Corners& corners) {
  const glm::dvec2 p(corners[1] - corners[0]), q(corners[2] - corners[0]);
  return (p.x * q.y - p.y * q.x) / 2 / pixelUnits / pixelUnits;
}

double areaOf(const Corners& corners) { return std::abs(signedArea(corners)); }

/// A triangle with an edge that passes the sample at about the distance by which `bits` of sub-pixel precision move its
/// ends.
CoverageProbe nearEdge(std::mt19937& random, int bits, const BitRange& range) {
  const int unit = range.first == coarseBits.first ? coarseUnit : 1;
  const int step = (pixelUnits >> bits) / unit, most = 7 * pixelUnits / unit / 32;
  for (;;) {
    const glm::ivec2 start = 2 * pointBetween(random, -most, most) + 1;
    const glm::ivec2 nudge = 2 * (pointBetween(random, -step, step) / 2);
    const glm::ivec2 end = 2 * pointBetween(random, -most, most) + 1;
    const Corners corners{unit * start, unit * (nudge - start), unit * end};
    if (areaOf(corners) > 0.03) return {corners, range};
  }
}

/// A triangle with an edge through the sample, for all snappings of coarseBits.
CoverageProbe throughSample(std::mt19937& random) {
  for (;;) {
    const glm::ivec2 start = pointBetween(random, -7, 7);
    const Corners corners{onGrid(start), onGrid(-start), onGrid(pointBetween(random, -7, 7))};
    if (areaOf(corners) > 0.01) return {corners, coarseBits};
  }
}

/// Adds a triangle at a pixel to the last draw.
void addProbe(Picture& picture, std::size_t pixel, const CoverageProbe& probe, double w) {
  const auto point = [&](std::size_t k) { return cornerPoint(picture, pixel, probe.corners[k], w); };
  addTriangle(picture, {point(0), point(1), point(2)});
}

template <typename MakeProbe>
ProbeSheet<CoverageProbe> coverageSheet(const std::string& name, const std::string& catches,
                                        const MakeProbe& makeProbe) {
  ProbeSheet<CoverageProbe> sheet;
  Picture picture(16);
  addDraw(picture, 1);
  for (int pixel = 0; pixel < 256; ++pixel) {
    sheet.pixels.push_back(makeProbe(pixel));
    addProbe(picture, static_cast<std::size_t>(pixel), sheet.pixels.back(), 1);
  }
  sheet.vector = makeVector(name, catches, picture);
  return sheet;
}

/// Two triangles on either side of an edge through the sample.
std::array<Corners, 2> besideEdge(std::mt19937& random, int offset) {
  for (;;) {
    const glm::ivec2 start = pointBetween(random, -7, 7), left = pointBetween(random, -7, 7),
                     right = pointBetween(random, -7, 7);
    const glm::ivec2 from = onGrid(start, offset), to = onGrid(-start, offset);
    const std::array<Corners, 2> pair{Corners{from, to, onGrid(left, offset)},
                                      Corners{from, to, onGrid(right, offset)}};
    if (signedArea(pair[0]) > 0.01 && signedArea(pair[1]) < -0.01) return pair;
  }
}

/// Pixel 8 k + v shows pair k: bits 0 and 1 of v reverse the windings of the triangles, bit 2 the order of drawing.
ProbeSheet<SharedEdgeProbe> sharedEdgeSheet(const std::string& name, std::mt19937& random, const BitRange& bits,
                                            int offset) {
  ProbeSheet<SharedEdgeProbe> sheet;
  Picture picture(16);
  std::array<Corners, 2> pair;
  for (std::size_t pixel = 0; pixel < 256; ++pixel) {
    if (pixel % 8 == 0) pair = besideEdge(random, offset);
    SharedEdgeProbe probe{{{{pair[0], bits}, {pair[1], bits}}}};
    for (std::size_t t = 0; t < 2; ++t) {
      Corners& corners = probe.triangles[t].corners;
      if (pixel >> t & 1) std::swap(corners[0], corners[1]);
      // The shared edge begins at any of the corners.
      std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>((pixel / 8 + t) % 3), corners.end());
    }
    sheet.pixels.push_back(probe);
  }
  for (const bool isLast : {false, true})
    for (const std::size_t t : {0u, 1u}) {
      addDraw(picture, static_cast<raster::ItemId>(t + 1));
      for (std::size_t pixel = 0; pixel < 256; ++pixel)
        if (((pixel & 4) != 0) == (isLast == (t == 0)))
          addProbe(picture, pixel, sheet.pixels[pixel].triangles[t], isLast ? 1 : 2);
    }
  sheet.vector = makeVector(name, "samples on shared edges that both triangles cover, or none", picture);
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
  return {static_cast<raster::ItemId>(coordinates.border), std::abs(offset) < roundoff ? 0 : std::abs(offset),
          offset > -roundoff, 0x1p-24 * texels * largest * triangle.depthRatio()};
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

/// The vector of the suite with the binary32 numbers around each k/N, where N is no power of two: a product u N that is
/// rounded to binary32 reaches the border from below. Pixels whose item ID is sure anyway have a distance of 1.
ProbeSheet<TexelProbe> productSheet(int texels) {
  ProbeSheet<TexelProbe> sheet{texelBorders(texels), {}};
  const raster::DrawList& list = sheet.vector.list;
  const raster::Scissor& scissor = sheet.vector.faces.front().face.scissor;
  for (const raster::Draw& draw : list.draws)
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; i += 3) {
      const bool isU = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)].width == texels;
      const glm::vec2& texcoord = list.texcoords[list.indices[i]];
      const double position = static_cast<double>(isU ? texcoord.x : texcoord.y) * texels;
      const double border = std::nearbyint(position), offset = position - border;
      const bool isInside = border > 0 && border < texels;
      sheet.pixels.push_back({draw.offset + static_cast<raster::ItemId>(std::clamp(border, 0.0, texels - 1.0)),
                              isInside ? std::abs(offset) : 1, !isInside || offset >= 0, 0x1p-24 * position});
    }
  const TexelProbe background{raster::backgroundId(list.format), 1, true, 1};
  sheet.pixels.resize(static_cast<std::size_t>(scissor.width) * static_cast<std::size_t>(scissor.height), background);
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
  const auto addSnapping = [&](int bits, const auto& makeProbe) {
    const std::string text = std::to_string(bits);
    probes.coverage.push_back(coverageSheet(
        "snapping-" + text, "sub-pixel bits and rounding of vertices, most of all of " + text + " bits", makeProbe));
  };
  for (int bits = 4; bits <= 12; ++bits) addSnapping(bits, [&](int) { return nearEdge(random, bits, coarseBits); });
  probes.coverage.push_back(
      coverageSheet("edge-rule", "which samples on edges are covered", [&](int) { return throughSample(random); }));
  // Every other probe shows that a device has at least 13 bits.
  for (int bits = 13; bits <= 16; ++bits)
    addSnapping(bits, [&](int pixel) { return nearEdge(random, pixel % 2 == 0 ? bits : 4 + pixel / 2 % 9, fineBits); });
  probes.sharedEdges = {sharedEdgeSheet("shared-edges", random, coarseBits, coarseUnit),
                        sharedEdgeSheet("shared-edges-fine", random, {13, 16}, 1),
                        sharedEdgeSheet("shared-edges-exact", random, {exactBits, exactBits}, 0)};
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
      productSheet(1000),
  };
  probes.depths = {formatSteps(), fineSteps()};
  for (TestVector& vector : coverageVectors())
    if (vector.name == "edges-beyond-the-view" || vector.name == "near-plane-sheet") {
      vector.name = "clipping-" + vector.name;
      probes.clipping.push_back(std::move(vector));
    }
  return probes;
}

std::vector<TestVector> vectorsOf(const ProbingSet& probes) {
  std::vector<TestVector> vectors;
  for (const auto& sheet : probes.coverage) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.sharedEdges) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.texels) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.interpolation) vectors.push_back(sheet.vector);
  for (const auto& sheet : probes.depths) vectors.push_back(sheet.vector);
  vectors.insert(vectors.end(), probes.clipping.begin(), probes.clipping.end());
  return vectors;
}

}  // namespace hemitex::reference
