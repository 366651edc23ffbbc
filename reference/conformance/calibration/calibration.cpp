#include "reference/conformance/calibration/calibration.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "raster/plain/rules.h"

namespace hemitex::reference {
namespace {

using raster::ItemBuffer;
using raster::ItemId;

constexpr ItemId nothing = 0xffffffff;  // the background of the probes

// --- snapping and edges ---

constexpr std::int64_t pixelUnits = 16384;  // unit of a probe's corners

/// The multiple of `step` that a coordinate snaps to. Samples are multiples, so that the coordinate may be relative.
std::int64_t snapTo(std::int64_t coordinate, std::int64_t step, SnapRounding rounding) {
  const std::int64_t raised = coordinate + (rounding == SnapRounding::Nearest ? step / 2 : 0);
  // Steps are powers of two: clearing the lower bits rounds down, also for negative numbers.
  return raised & -step;
}

struct Snapping {
  int bits;
  SnapRounding rounding;
};

/// How often the answers contradict a snapping. On edges the top-left rule is expected, but any answer is allowed.
struct Contradictions {
  int sure = 0, onEdges = 0;
};

/// Whether rows are in reverse order, once or twice. A device that draws the picture upside down and reverses its rows
/// on readback shows the right picture, but its top edges are the bottom edges of the rules.
struct RowOrder {
  bool isReversed = false;    ///< each answer is that of the probe in the opposite row
  bool isUpsideDown = false;  ///< each probe is seen upside down
};

CoverageProbe upsideDown(CoverageProbe probe) {
  for (glm::ivec2& corner : probe.corners) corner.y = -corner.y;
  return probe;
}

std::size_t opposite(std::size_t pixel, const ItemBuffer& buffer) {
  const auto width = static_cast<std::size_t>(buffer.width), height = static_cast<std::size_t>(buffer.height);
  return (height - 1 - pixel / width) * width + pixel % width;
}

Contradictions contradictionsOf(const ProbingSet& probes, std::span<const ItemBuffer> answers, const Snapping& snapping,
                                const RowOrder& order) {
  Contradictions contradictions;
  for (std::size_t s = 0; s < probes.coverage.size(); ++s)
    for (std::size_t pixel = 0; pixel < probes.coverage[s].pixels.size(); ++pixel) {
      const CoverageProbe& shown = probes.coverage[s].pixels[order.isReversed ? opposite(pixel, answers[s]) : pixel];
      const CoverageProbe probe = order.isUpsideDown ? upsideDown(shown) : shown;
      const Coverage expected = coverageOf(probe, snapping.bits, snapping.rounding);
      const bool isCovered = expected == Coverage::Inside || expected == Coverage::OnIncludedEdge;
      const bool isSure = expected == Coverage::Inside || expected == Coverage::Outside;
      if (answers[s].ids[pixel] == (isCovered ? 1 : nothing)) continue;
      // Another item ID is wrong wherever the sample lies.
      const bool isId = answers[s].ids[pixel] == 1 || answers[s].ids[pixel] == nothing;
      (isSure || !isId ? contradictions.sure : contradictions.onEdges) += 1;
    }
  return contradictions;
}

std::string nameOf(const Snapping& snapping) {
  return std::to_string(snapping.bits) + " bits, " +
         (snapping.rounding == SnapRounding::Nearest ? "nearest" : "truncated");
}

/// The snapping with the fewest contradictions.
struct CoverageFit {
  Snapping snapping{};
  Contradictions contradictions;

  bool fitsAll() const { return contradictions.sure == 0 && contradictions.onEdges == 0; }
};

CoverageFit fitCoverage(const ProbingSet& probes, std::span<const ItemBuffer> answers, const RowOrder& order) {
  std::optional<CoverageFit> best;
  for (int bits = 4; bits <= 12; ++bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) {
      const Snapping snapping{bits, rounding};
      const Contradictions contradictions = contradictionsOf(probes, answers, snapping, order);
      if (!best || contradictions.sure < best->contradictions.sure) best = {snapping, contradictions};
    }
  return *best;
}

/// False if the rows are not in order, so that other probes show nothing.
bool calibrateCoverage(const ProbingSet& probes, std::span<const ItemBuffer> answers, Calibration& calibration) {
  const CoverageFit fit = fitCoverage(probes, answers, {});
  calibration.profile.subpixelBits = fit.snapping.bits;
  calibration.profile.snapRounding = fit.snapping.rounding;
  calibration.profile.edgeRule = fit.contradictions.onEdges == 0 ? EdgeRule::TopLeft : EdgeRule::Any;
  if (fit.fitsAll()) return true;
  // The edge rule Any would hide a picture that is upside down twice.
  const auto fits = [&](const RowOrder& order) { return fitCoverage(probes, answers, order).fitsAll(); };
  std::string reversal;
  if (fits({.isUpsideDown = true}))
    reversal =
        "samples on edges belong to bottom edges instead of top edges, as if the picture is drawn upside down and its "
        "rows are reversed on readback; negate y in the vertex stage instead of reversing rows";
  else if (fits({.isReversed = true}))
    reversal = "the rows are in reverse order; row 0 is y/w = -1, so read the rows from the other end";
  else if (fits({.isReversed = true, .isUpsideDown = true}))
    reversal = "the picture is upside down; row 0 is y/w = -1, so negate y in the vertex stage";
  if (!reversal.empty()) {
    calibration.faults.push_back("coverage: " + reversal);
    return false;
  }
  if (fit.contradictions.sure > 0)
    calibration.faults.push_back("coverage: no snapping from 4 to 12 bits explains all samples; the closest, " +
                                 nameOf(fit.snapping) + ", is wrong at " + std::to_string(fit.contradictions.sure));
  return true;
}

// --- texels ---

/// Close to the distance of the probes that are farthest from a border, a quarter of a texel.
constexpr double maxDistance = 0.249;

/// A probe measures the rounding errors of one triangle; another has larger ones.
constexpr double roundingsMargin = 4;

/// The probes that show the wrong texel, and how many samples show neither texel beside their border.
struct WrongTexels {
  std::vector<TexelProbe> probes;
  int strangers = 0;
};

WrongTexels wrongTexels(std::span<const ProbeSheet<TexelProbe>> sheets, std::span<const ItemBuffer> answers) {
  WrongTexels wrong;
  for (std::size_t s = 0; s < sheets.size(); ++s)
    for (std::size_t pixel = 0; pixel < sheets[s].pixels.size(); ++pixel) {
      const TexelProbe& probe = sheets[s].pixels[pixel];
      const auto above = static_cast<ItemId>(probe.border), below = above - 1;
      const ItemId id = answers[s].ids[pixel];
      wrong.strangers += id != above && id != below;
      if (id != (probe.isAbove ? above : below)) wrong.probes.push_back(probe);
    }
  return wrong;
}

void calibrateTexels(const ProbingSet& probes, std::span<const ItemBuffer> answers, Calibration& calibration) {
  const std::size_t small = probes.texels.size();
  const WrongTexels ofSmall = wrongTexels(probes.texels, answers.first(small));
  const WrongTexels ofLarge = wrongTexels(probes.interpolation, answers.subspan(small));
  double largestWrong = 0;
  for (const TexelProbe& probe : ofSmall.probes) largestWrong = std::max(largestWrong, probe.distance);
  const double precision = 2 * largestWrong;
  double roundings = 0;
  for (const TexelProbe& probe : ofLarge.probes)
    if (probe.distance >= precision)
      roundings = std::max({roundings, 0.5, (probe.distance - precision) / probe.rounding});
  calibration.profile.texelPrecision = precision;
  calibration.profile.interpolationError = roundingsMargin * roundings;
  if (const int strangers = ofSmall.strangers + ofLarge.strangers; strangers > 0)
    calibration.faults.push_back("texels: " + std::to_string(strangers) +
                                 " samples show neither texel beside the border that they probe");
  else if (largestWrong > maxDistance)
    calibration.faults.push_back("texels: coordinates are off by a quarter of a texel or more");
}

// --- depth ---

void calibrateDepths(const ProbingSet& probes, std::span<const ItemBuffer> answers, Calibration& calibration) {
  std::array<int, 4> wrong{};  // by DepthStep
  int strangers = 0;
  for (std::size_t s = 0; s < probes.depths.size(); ++s)
    for (std::size_t pixel = 0; pixel < probes.depths[s].pixels.size(); ++pixel) {
      const DepthProbe& probe = probes.depths[s].pixels[pixel];
      const ItemId id = answers[s].ids[pixel];
      strangers += id != 1 && id != 2;
      wrong[static_cast<std::size_t>(probe.step)] += id != probe.nearer;
    }
  const auto confuses = [&](DepthStep step) { return wrong[static_cast<std::size_t>(step)] > 0; };
  calibration.profile.depthFormat = confuses(DepthStep::Float32)   ? DepthFormat::Unorm16
                                    : confuses(DepthStep::Unorm24) ? DepthFormat::Float32
                                    : confuses(DepthStep::Fine)    ? DepthFormat::Unorm24
                                                                   : DepthFormat::Float32;
  if (strangers > 0)
    calibration.faults.push_back("depth: " + std::to_string(strangers) +
                                 " samples show neither of the two triangles that cover them");
  else if (confuses(DepthStep::Unorm16))
    calibration.faults.push_back("depth: triangles are confused that even 16 bits tell apart, " +
                                 std::to_string(wrong[0]) + " times");
}

}  // namespace

Coverage coverageOf(const CoverageProbe& probe, int subpixelBits, SnapRounding rounding) {
  const std::int64_t step = pixelUnits >> subpixelBits;
  std::array<raster::SnappedPoint, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = {snapTo(probe.corners[k].x, step, rounding), snapTo(probe.corners[k].y, step, rounding)};
  const raster::SnappedTriangle triangle = raster::snappedTriangle({}, {}, corners);
  if (triangle.area == 0) return Coverage::Outside;
  const raster::Weights weights = weightsAt(triangle, {0, 0});
  Coverage coverage = Coverage::Inside;
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] < 0) return Coverage::Outside;
    if (weights[k] > 0 || coverage == Coverage::OnOtherEdge) continue;
    coverage = raster::ownsSamples(directionOf(triangle, k)) ? Coverage::OnIncludedEdge : Coverage::OnOtherEdge;
  }
  return coverage;
}

Calibration calibrate(const ProbingSet& probes, std::span<const ItemBuffer> answers) {
  const std::size_t texels = probes.coverage.size();
  const std::size_t depths = texels + probes.texels.size() + probes.interpolation.size();
  assert(answers.size() == depths + probes.depths.size());
  Calibration calibration;
  if (!calibrateCoverage(probes, answers.first(texels), calibration)) return calibration;
  calibrateTexels(probes, answers.subspan(texels, depths - texels), calibration);
  calibrateDepths(probes, answers.subspan(depths), calibration);
  return calibration;
}

}  // namespace hemitex::reference
