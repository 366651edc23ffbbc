#include "reference/conformance/calibration/calibration.h"

#include <algorithm>
#include <cassert>

#include "raster/plain/rules.h"

namespace hemitex::reference {
namespace {

using raster::ItemBuffer;
using raster::ItemId;

constexpr ItemId nothing = 0xffffffff;  // the background of the probes

// --- snapping and edges ---

constexpr std::int64_t unitsPerPixel = std::int64_t{1} << exactBits;  // unit of a probe's corners

/// The multiple of `step` that a coordinate snaps to. Samples are multiples, so that the coordinate may be relative.
std::int64_t snapTo(std::int64_t coordinate, std::int64_t step, SnapRounding rounding) {
  if (rounding == SnapRounding::None) return coordinate;
  const std::int64_t raised = coordinate + (rounding == SnapRounding::Nearest ? step / 2 : 0);
  // Steps are powers of two: clearing the lower bits rounds down, also for negative numbers.
  return raised & -step;
}

struct Snapping {
  int bits;
  SnapRounding rounding;
};

/// How many probes are for a snapping, and how often their answers contradict it. On edges the top-left rule is
/// expected, but any answer is allowed.
struct Contradictions {
  int sure = 0, onEdges = 0, probes = 0;
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
      if (!probe.bits.contains(snapping.bits)) continue;
      ++contradictions.probes;
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

/// A snapping and its contradictions.
struct CoverageFit {
  Snapping snapping{};
  Contradictions contradictions;

  bool fitsAll() const { return contradictions.sure == 0 && contradictions.onEdges == 0; }
};

std::vector<CoverageFit> coverageFits(const ProbingSet& probes, std::span<const ItemBuffer> answers,
                                      const RowOrder& order) {
  std::vector<CoverageFit> fits;
  const auto consider = [&](const Snapping& snapping) {
    const auto isFor = [&](const auto& sheet) { return sheet.pixels.front().bits.contains(snapping.bits); };
    if (std::any_of(probes.coverage.begin(), probes.coverage.end(), isFor))
      fits.push_back({snapping, contradictionsOf(probes, answers, snapping, order)});
  };
  for (int bits = 4; bits <= maxSubpixelBits; ++bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) consider({bits, rounding});
  consider({exactBits, SnapRounding::None});
  return fits;
}

CoverageFit fitCoverage(const ProbingSet& probes, std::span<const ItemBuffer> answers, const RowOrder& order) {
  const std::vector<CoverageFit> fits = coverageFits(probes, answers, order);
  return *std::min_element(fits.begin(), fits.end(), [](const CoverageFit& a, const CoverageFit& b) {
    return a.contradictions.sure < b.contradictions.sure;
  });
}

/// How two triangles cover the samples on an edge that they share.
struct SharedEdges {
  int pairs = 0, uncovered = 0, coveredTwice = 0, uneven = 0;  ///< pairs, and those that break each part of the rule
  int unexpected = 0;                                          ///< pixels that do not follow the top-left rule
};

SharedEdges sharedEdgesOf(const ProbeSheet<SharedEdgeProbe>& sheet, const ItemBuffer& answer,
                          const Snapping& snapping) {
  SharedEdges edges;
  for (std::size_t first = 0; first < sheet.pixels.size(); first += 8, ++edges.pairs) {
    const auto shown = [&](std::size_t pixel) { return answer.ids[first + pixel]; };
    bool isUncovered = false, isTwice = false, isUneven = false;
    for (std::size_t k = 0; k < 8; ++k) {
      const bool isFirst = coverageOf(sheet.pixels[first + k].triangles[0], snapping.bits, snapping.rounding) ==
                           Coverage::OnIncludedEdge;
      edges.unexpected += shown(k) != (isFirst ? 1u : 2u);
      isUncovered |= shown(k) == nothing;
      isTwice |= shown(k) != shown(k ^ 4);
      isUneven |= shown(k) != shown(k & 4);
    }
    edges.uncovered += isUncovered;
    edges.coveredTwice += !isUncovered && isTwice;
    edges.uneven += !isUncovered && !isTwice && isUneven;
  }
  return edges;
}

/// Completes the edge rule, or reports a fault: exactly one of two triangles covers a sample on their edge.
void calibrateSharedEdges(const ProbingSet& probes, std::span<const ItemBuffer> answers, const Snapping& snapping,
                          Calibration& calibration) {
  const auto isFor = [&](const auto& sheet) { return sheet.pixels[0].triangles[0].bits.contains(snapping.bits); };
  const auto sheet = std::find_if(probes.sharedEdges.begin(), probes.sharedEdges.end(), isFor);
  if (sheet == probes.sharedEdges.end()) return;
  const SharedEdges edges =
      sharedEdgesOf(*sheet, answers[static_cast<std::size_t>(sheet - probes.sharedEdges.begin())], snapping);
  if (edges.unexpected > 0) calibration.profile.edgeRule = EdgeRule::Any;
  const auto report = [&](int count, const std::string& what) {
    if (count > 0)
      calibration.faults.push_back("coverage: " + what + ", at " + std::to_string(count) + " of " +
                                   std::to_string(edges.pairs) +
                                   " edges; any fill rule gives each sample on it to one of the two triangles");
  };
  report(edges.uncovered, "samples on a shared edge are in neither triangle");
  report(edges.coveredTwice, "samples on a shared edge are in both triangles");
  report(edges.uneven, "the windings of two triangles decide which of them has the samples on their edge");
}

/// How the rows are reversed, if that explains all answers; else empty.
std::string reversalOf(const ProbingSet& probes, std::span<const ItemBuffer> answers) {
  const auto fits = [&](const RowOrder& order) { return fitCoverage(probes, answers, order).fitsAll(); };
  if (fits({.isUpsideDown = true}))
    return "samples on edges belong to bottom edges instead of top edges, as if the picture is drawn upside down and "
           "its rows are reversed on readback; negate y in the vertex stage instead of reversing rows";
  if (fits({.isReversed = true}))
    return "the rows are in reverse order; row 0 is y/w = -1, so read the rows from the other end";
  if (fits({.isReversed = true, .isUpsideDown = true}))
    return "the picture is upside down; row 0 is y/w = -1, so negate y in the vertex stage";
  return "";
}

/// False if the rows are not in order, so that other probes show nothing.
bool calibrateCoverage(const ProbingSet& probes, std::span<const ItemBuffer> answers,
                       std::span<const ItemBuffer> edgeAnswers, Calibration& calibration) {
  const CoverageFit fit = fitCoverage(probes, answers, {});
  calibration.profile.subpixelBits = std::min(fit.snapping.bits, maxSubpixelBits);
  calibration.profile.snapRounding = fit.snapping.rounding;
  calibration.profile.edgeRule = fit.contradictions.onEdges == 0 ? EdgeRule::TopLeft : EdgeRule::Any;
  // The edge rule Any would hide a picture that is upside down twice.
  if (const std::string reversal = fit.fitsAll() ? "" : reversalOf(probes, answers); !reversal.empty()) {
    calibration.faults.push_back("coverage: " + reversal);
    return false;
  }
  if (fit.contradictions.sure > 0)
    calibration.faults.push_back("coverage: no snapping from 4 to 16 bits explains all samples; each is wrong at " +
                                 std::to_string(fit.contradictions.sure) + " or more");
  else
    calibrateSharedEdges(probes, edgeAnswers, fit.snapping, calibration);
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
      const ItemId id = answers[s].ids[pixel], below = probe.above - 1;
      wrong.strangers += id != probe.above && id != below;
      if (id != (probe.isAbove ? probe.above : below)) wrong.probes.push_back(probe);
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

std::vector<SnappingFit> snappingFits(const ProbingSet& probes, std::span<const ItemBuffer> answers) {
  std::vector<SnappingFit> fits;
  for (const auto& [snapping, contradictions] : coverageFits(probes, answers, {}))
    fits.push_back({snapping.bits, snapping.rounding, contradictions.probes, contradictions.sure});
  return fits;
}

Coverage coverageOf(const CoverageProbe& probe, int subpixelBits, SnapRounding rounding) {
  const std::int64_t step = unitsPerPixel >> subpixelBits;
  std::array<raster::SnappedPoint, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = {snapTo(probe.corners[k].x, step, rounding), snapTo(probe.corners[k].y, step, rounding)};
  const raster::SnappedTriangle triangle = raster::snappedTriangle({}, {}, {}, corners);
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
  const auto next = [&](std::size_t count) {
    const std::span<const ItemBuffer> sheets = answers.first(count);
    answers = answers.subspan(count);
    return sheets;
  };
  const auto coverage = next(probes.coverage.size()), edges = next(probes.sharedEdges.size()),
             texels = next(probes.texels.size() + probes.interpolation.size()), depths = next(probes.depths.size());
  assert(answers.size() == probes.clipping.size());
  Calibration calibration;
  if (!calibrateCoverage(probes, coverage, edges, calibration)) return calibration;
  calibrateTexels(probes, texels, calibration);
  calibrateDepths(probes, depths, calibration);
  return calibration;
}

}  // namespace hemitex::reference
