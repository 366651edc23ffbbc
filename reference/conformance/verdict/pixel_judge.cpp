#include "reference/conformance/verdict/pixel_judge.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "raster/interface/depth_test.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// A triangle that may cover the sample, and be no hole there.
struct Candidate {
  const DeviceTriangle* triangle;
  Region region;
  raster::CoveredSample covered;  ///< by the rules; none where they do not cover the sample
  double best = 0, worst = 0;     ///< the bounds of its depth, larger where it wins
  bool mayVanish = false;         ///< a device may cull it, or find a hole
  bool mayBeCut = false;          ///< by the near plane

  bool covers() const { return covered.triangle; }
};

/// Bounds the depth of a candidate on all devices.
void setDepths(const JudgedFace& face, Candidate& candidate) {
  const double slack = candidate.triangle->depthSlack;
  const double nearest = slack < 1 ? candidate.region.nearest / (1 - slack) : HUGE_VAL;
  const double farthest = candidate.region.farthest / (1 + slack);
  candidate.mayBeCut = nearest > face.nearest;
  const bool isReversed = keepsFarther(face.list.depthTest);
  candidate.best = isReversed ? -farthest : nearest;
  candidate.worst = isReversed ? -nearest : farthest;
}

const raster::Draw& drawOf(const JudgedFace& face, const DeviceTriangle& triangle) {
  return face.list.draws[triangle.draw];
}

// --- texels of a triangle ---

/// Texels [first, last] of a map's side.
struct TexelRange {
  std::size_t first, last;
};

TexelRange texelRange(const JudgedFace& face, const Candidate& candidate, int axis, int size) {
  const std::array<raster::ViewVertex, 3>& vertices = candidate.triangle->vertices;
  const auto coordinate = [axis](const raster::ViewVertex& v) { return axis == 0 ? v.u : v.v; };
  const auto [low, high] = std::minmax({coordinate(vertices[0]), coordinate(vertices[1]), coordinate(vertices[2])});
  // u is the average of the vertices' u with weights b/w. If w is off by a factor from 1 - e to 1 + e, the ratio of two
  // weights changes by a factor of at most r = (1 + e)/(1 - e). A normalized weight p then becomes at most
  // p r / (p r + 1 - p). The increase is at most (sqrt(r) - 1)/(sqrt(r) + 1) = e/(1 + sqrt(1 - e^2)), and u changes by
  // at most this fraction of its range.
  const double slack = std::min(candidate.triangle->depthSlack, 1.0);
  const double drift = slack / (1 + std::sqrt(1 - slack * slack)) * (high - low);
  const DeviceTriangle& triangle = *candidate.triangle;
  const double error =
      texelError(face.profile, size, triangle.largest[axis], triangle.nearestDepth, candidate.region.leastInverse);
  return {texelAt((candidate.region.low[axis] - drift) * size - error, size),
          texelAt((candidate.region.high[axis] + drift) * size + error, size)};
}

/// Whether a device may find a texel in the index map of the triangle's draw that `matches` accepts.
template <typename Matches>
bool mayFindTexel(const JudgedFace& face, const Candidate& candidate, const Matches& matches) {
  const raster::IndexMap& map = mapOf(face.list, drawOf(face, *candidate.triangle));
  const TexelRange columns = texelRange(face, candidate, 0, map.width);
  const TexelRange rows = texelRange(face, candidate, 1, map.height);
  for (std::size_t row = rows.first; row <= rows.last; ++row)
    for (std::size_t column = columns.first; column <= columns.last; ++column)
      if (matches(map.ids[row * static_cast<std::size_t>(map.width) + column])) return true;
  return false;
}

bool isHoleTexel(ItemId texel) { return texel == raster::holeTexel; }

bool mapHasHoles(const JudgedFace& face, const DeviceTriangle& triangle) {
  const std::optional<int> map = drawOf(face, triangle).indexMap;
  return map && face.hasHoles[static_cast<std::size_t>(*map)];
}

bool mayMeetHole(const JudgedFace& face, const Candidate& candidate) {
  return mapHasHoles(face, *candidate.triangle) && mayFindTexel(face, candidate, isHoleTexel);
}

// --- candidates ---

/// The part of a triangle that the rules show at a sample, if they do.
raster::CoveredSample coveredBy(const JudgedFace& face, const DeviceTriangle& triangle,
                                const raster::SnappedPoint& sample) {
  const raster::Weights weights = weightsAt(triangle, sample);
  if (triangle.area == 0 || isCulled(drawOf(face, triangle), triangle.facesAway) || !raster::covers(triangle, weights))
    return {};
  const raster::CoveredSample covered = coveredSample(triangle, weights);
  return mapHasHoles(face, triangle) && isHole(face.list, covered) ? raster::CoveredSample{} : covered;
}

std::vector<Candidate> candidatesAt(const JudgedFace& face, std::span<const DeviceTriangle* const> triangles,
                                    const raster::SnappedPoint& sample) {
  std::vector<Candidate> candidates;
  for (const DeviceTriangle* triangle : triangles) {
    const raster::Draw& draw = drawOf(face, *triangle);
    if (isCulled(draw, triangle->facesAway) && !triangle->mayFlip) continue;
    const auto region = regionAt(*triangle, {sample.x, sample.y}, face.profile.edgeRule);
    if (!region) continue;
    Candidate& candidate = candidates.emplace_back(Candidate{triangle, *region, coveredBy(face, *triangle, sample)});
    setDepths(face, candidate);
    candidate.mayVanish = (draw.cull != raster::Cull::None && triangle->mayFlip) || mayMeetHole(face, candidate);
  }
  return candidates;
}

// --- guaranteed coverage of the sample ---

using Corner = std::tuple<double, double, double, double>;

Corner cornerOf(const raster::ViewVertex& vertex) { return {vertex.x, vertex.y, vertex.w, vertex.z}; }

/// An edge that may pass over the sample, its ends in order.
struct PassingEdge {
  Corner low, high;
  int direction;  ///< 1 from low to high, -1 the other way
  std::size_t candidate;

  bool isSameLine(const PassingEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<PassingEdge> passingEdges(const JudgedFace& face, const std::vector<Candidate>& candidates,
                                      const glm::dvec2& sample) {
  std::vector<PassingEdge> edges;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (std::size_t k = 0; k < 3; ++k) {
      const DeviceTriangle& triangle = *candidates[c].triangle;
      if (candidates[c].mayVanish || !edgeMayPass(triangle, k, sample, face.profile.edgeRule)) continue;
      const Corner from = cornerOf(triangle.vertices[k]), to = cornerOf(triangle.vertices[(k + 1) % 3]);
      edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1, c});
    }
  std::sort(edges.begin(), edges.end(), [](const PassingEdge& a, const PassingEdge& b) {
    return std::tie(a.low, a.high, a.candidate) < std::tie(b.low, b.high, b.candidate);
  });
  return edges;
}

/// A group of candidates at the sample.
struct Sheet {
  int winding = 0;           ///< winding number around the sample
  bool hasBoundary = false;  ///< an edge that may pass over the sample has no counterpart
  double worst = HUGE_VAL;
};

/// A lower bound of the visible depth at the sample, -HUGE_VAL where the background may show.
///
/// Triangles joined along shared edges move as one mesh. Edges that occur equally often in both directions cancel, and
/// the rest is the boundary of the mesh. While no boundary edge passes over the sample, the winding number of the mesh
/// around it stays the same. Where it is not zero, some triangle of the mesh covers the sample. Triangles that a device
/// may cull, or show a hole of, belong to no mesh.
double certainDepth(const JudgedFace& face, const std::vector<Candidate>& candidates, const glm::dvec2& sample) {
  const std::vector<PassingEdge> edges = passingEdges(face, candidates, sample);
  boost::disjoint_sets_with_storage<> groups(candidates.size());  // candidates that share edges
  std::vector<char> hasBoundary(candidates.size());
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    int sum = 0;
    for (end = first; end < edges.size() && edges[end].isSameLine(edges[first]); ++end) {
      sum += edges[end].direction;
      groups.union_set(edges[first].candidate, edges[end].candidate);
    }
    if (sum != 0) hasBoundary[edges[first].candidate] = 1;
  }
  std::vector<Sheet> sheets(candidates.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (candidates[c].mayVanish) continue;
    Sheet& sheet = sheets[groups.find_set(c)];
    if (candidates[c].covers()) sheet.winding += candidates[c].triangle->area > 0 ? 1 : -1;
    // The near plane may clip the part in front of it.
    sheet.hasBoundary |= hasBoundary[c] != 0 || candidates[c].mayBeCut;
    sheet.worst = std::min(sheet.worst, candidates[c].worst);
  }
  double depth = -HUGE_VAL;
  for (const Sheet& sheet : sheets)
    if (sheet.winding != 0 && !sheet.hasBoundary) depth = std::max(depth, sheet.worst);
  return depth > face.cleared ? depth : -HUGE_VAL;
}

// --- possible item IDs of a triangle ---

/// Whether a device may show the triangle from its front or its back.
bool mayFace(const DeviceTriangle& triangle, const raster::Draw& draw, bool away) {
  return (triangle.facesAway == away || triangle.mayFlip) && !isCulled(draw, away);
}

bool mayGive(const JudgedFace& face, const Candidate& candidate, ItemId id) {
  const DeviceTriangle& triangle = *candidate.triangle;
  const raster::Draw& draw = drawOf(face, triangle);
  const bool isOpen = mayMeetHole(face, candidate) && !mayFindTexel(face, candidate, std::not_fn(isHoleTexel));
  if (isOpen) return false;
  if (draw.back && id == *draw.back && mayFace(triangle, draw, true)) return true;
  if (!mayFace(triangle, draw, false) && (draw.back || !mayFace(triangle, draw, true))) return false;
  if (face.list.value != raster::PixelValue::ItemIds) return id == flatValue(face.list, draw, triangle.number);
  if (!draw.indexMap) return id == draw.offset;
  return mayFindTexel(face, candidate, [&](ItemId texel) {
    return !isHoleTexel(texel) && raster::blend(face.list.format, face.list.blend, draw.offset, texel) == id;
  });
}

bool haveSameCorners(const DeviceTriangle& a, const DeviceTriangle& b) {
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(),
                    [](const auto& p, const auto& q) { return cornerOf(p) == cornerOf(q); });
}

/// Whether an earlier candidate that cannot vanish has the same corners; or a later one, where of equal depths the last
/// one stays. Then it covers the same samples at the same depths on every device, and this one is never visible.
bool hasTwinThatStays(raster::DepthTest test, const std::vector<Candidate>& candidates, const Candidate& candidate) {
  const bool keepsLast = raster::keepsLast(test);
  const Candidate* const first = keepsLast ? &candidate + 1 : candidates.data();
  const Candidate* const end = keepsLast ? candidates.data() + candidates.size() : &candidate;
  return std::any_of(first, end, [&](const Candidate& other) {
    return !other.mayVanish && haveSameCorners(*other.triangle, *candidate.triangle);
  });
}

/// The candidate that the rules show; null for the background.
const Candidate* expectedOf(raster::DepthTest test, const std::vector<Candidate>& candidates) {
  const Candidate* expected = nullptr;
  for (const Candidate& candidate : candidates)
    if (candidate.covers() && (!expected || passes(test, candidate.covered, expected->covered, raster::isNearer)))
      expected = &candidate;
  return expected;
}

/// The smallest difference of depths that a list stores.
double storedStep(raster::DepthPrecision precision) {
  switch (precision) {
    case raster::DepthPrecision::Exact:
      return 0;
    case raster::DepthPrecision::Unorm16:
      return 1.0 / 0xffff;
    default:
      return 1.0 / 0xffffff;
  }
}

}  // namespace

JudgedFace judgedFace(const raster::DrawList& list, const raster::Face& face, const DeviceProfile& profile) {
  // Two stored depths are each off by the error, and differ by `scale` times the difference of z/w.
  const raster::DepthRule rule = raster::depthRuleOf(list, face);
  const double error = std::max(depthError(profile), storedStep(list.depthPrecision)) / rule.scale;
  const bool isScene = list.clipDepth == raster::ClipDepth::None;
  // Depths are cleared to 1, or to 0 where the farther fragment passes.
  const double cleared = keepsFarther(list.depthTest) ? -rule.offset / rule.scale : (rule.offset - 1) / rule.scale;
  std::vector<char> holes;
  for (const raster::IndexMap& map : list.indexMaps) holes.push_back(raster::hasHoles(map));
  return {list, profile, 2 * error, isScene ? 1 / rule.scale : HUGE_VAL, cleared + error, std::move(holes)};
}

PixelVerdict judgeId(const JudgedFace& face, std::span<const DeviceTriangle* const> triangles,
                     const raster::SnappedPoint& sample, ItemId found) {
  const std::vector<Candidate> candidates = candidatesAt(face, triangles, sample);
  const double certain = certainDepth(face, candidates, {sample.x, sample.y});
  if (found == raster::backgroundId(face.list.format))
    return certain > -HUGE_VAL ? PixelVerdict::Error : PixelVerdict::Coverage;

  const Candidate* const expected = expectedOf(face.list.depthTest, candidates);
  PixelVerdict verdict = PixelVerdict::Error;
  for (const Candidate& candidate : candidates) {
    const double best = candidate.best + face.depthTolerance;
    if (best < certain || !mayGive(face, candidate, found)) continue;
    if (face.profile.strictDepth && hasTwinThatStays(face.list.depthTest, candidates, candidate)) continue;
    // Without a texel to differ in, the triangle may show its other side.
    const bool hasTexel = face.list.value == raster::PixelValue::ItemIds && drawOf(face, *candidate.triangle).indexMap;
    if (&candidate == expected) return hasTexel ? PixelVerdict::Texel : PixelVerdict::Depth;
    const bool passesExpected = candidate.covers() && best >= expected->worst;
    if (passesExpected) verdict = PixelVerdict::Depth;
    if (verdict == PixelVerdict::Error) verdict = PixelVerdict::Coverage;
  }
  return verdict;
}

}  // namespace hemitex::reference
