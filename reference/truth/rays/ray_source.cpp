#include "reference/truth/rays/ray_source.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "reference/truth/rays/ray_caster.h"
#include "reference/truth/rays/sample_points.h"

namespace hemitex::reference {
namespace {

constexpr double moveIntoTriangle = 0x1p-30;

/// More pieces of a texel are sampled in groups, because trapezoids grow faster in number than pieces.
constexpr std::size_t maxPiecesTogether = 32;

std::uint32_t numberInScene(const radiosity::Scene& scene, std::uint32_t surface, std::uint32_t triangle) {
  for (std::uint32_t s = 0; s < surface; ++s)
    triangle += static_cast<std::uint32_t>(scene.surfaces[s].triangles.size());
  return triangle;
}

/// A point of a piece: v on the chart, and its position.
struct ChartPoint {
  double v;
  glm::dvec3 position{0.0};
};

/// The part of a vertical line on the chart that is inside a piece.
struct Chord {
  ChartPoint low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void include(const ChartPoint& point) {
    if (point.v < low.v) low = point;
    if (point.v > high.v) high = point;
  }
};

/// `u` must be in the range of the piece. Positions at its corners are exact. Both pieces at an edge get the same end.
Chord chordAt(const SurfacePiece& piece, double u) {
  Chord chord;
  for (std::size_t i = 0; i < piece.corner.size(); ++i) {
    const std::size_t next = (i + 1) % piece.corner.size();
    const bool isForward = piece.onChart[i].x < piece.onChart[next].x;
    const std::size_t from = isForward ? i : next, to = isForward ? next : i;
    const glm::dvec2 &left = piece.onChart[from], &right = piece.onChart[to];
    if (left.x == u) chord.include({left.y, piece.corner[from]});
    if (right.x == u) chord.include({right.y, piece.corner[to]});
    if (!(left.x < u && u < right.x)) continue;
    const double share = (u - left.x) / (right.x - left.x);
    chord.include({glm::mix(left.y, right.y, share), glm::mix(piece.corner[from], piece.corner[to], share)});
  }
  return chord;
}

using Pieces = std::span<const SurfacePiece* const>;

/// Where slabs begin and end: the corners of the pieces, ascending.
std::vector<double> bordersOf(Pieces pieces) {
  std::vector<double> borders;
  for (const SurfacePiece* piece : pieces)
    for (const glm::dvec2& place : piece->onChart) borders.push_back(place.x);
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

/// The trapezoids of a slab that have an area, upwards.
std::vector<ShootingTrapezoid> trapezoidsOf(Pieces pieces, double left, double right) {
  std::vector<std::pair<double, ShootingTrapezoid>> byHeight;
  for (const SurfacePiece* piece : pieces) {
    const auto [first, last] = std::minmax_element(piece->onChart.begin(), piece->onChart.end(),
                                                   [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
    if (first->x > left || last->x < right) continue;
    const Chord a = chordAt(*piece, left), b = chordAt(*piece, right);
    const glm::dvec3 across = b.low.position - a.low.position;
    const std::array<double, 2> width{glm::length(glm::cross(across, a.high.position - a.low.position)),
                                      glm::length(glm::cross(across, b.high.position - b.low.position))};
    if (width[0] + width[1] == 0) continue;
    byHeight.push_back({a.low.v + a.high.v + b.low.v + b.high.v,
                        {{a.low.position, b.low.position},
                         {a.high.position, b.high.position},
                         width,
                         piece->normal,
                         piece->triangle}});
  }
  std::stable_sort(byHeight.begin(), byHeight.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ShootingTrapezoid> trapezoids;
  for (auto& [height, trapezoid] : byHeight) {
    for (const std::size_t side : {0U, 1U})
      if (!trapezoids.empty()) trapezoid.upTo[side] += trapezoids.back().upTo[side];
    trapezoids.push_back(trapezoid);
  }
  return trapezoids;
}

/// Appends a range whose members are at the end of a list from `begin` on, if it has an area. `sum` is the area of the
/// previous ranges of the same list.
void appendRange(std::vector<ShootingRange>& ranges, double area, double& sum, std::size_t begin, std::size_t end) {
  if (area == 0) return;
  ranges.push_back({sum += area, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
}

/// Appends the slabs of pieces of one texel. Returns their area.
double appendSlabs(Pieces pieces, RaySource& raySource) {
  const std::vector<double> borders = bordersOf(pieces);
  double sum = 0;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const std::vector<ShootingTrapezoid> added = trapezoidsOf(pieces, borders[i - 1], borders[i]);
    if (added.empty()) continue;
    const std::size_t begin = raySource.trapezoids.size();
    raySource.trapezoids.insert(raySource.trapezoids.end(), added.begin(), added.end());
    appendRange(raySource.slabs, (added.back().upTo[0] + added.back().upTo[1]) / 2, sum, begin,
                raySource.trapezoids.size());
  }
  return sum;
}

/// Appends the texels of pieces of one column, upwards. Returns their area.
double appendTexels(Pieces pieces, RaySource& raySource) {
  double sum = 0;
  for (std::size_t first = 0, end = 0; first < pieces.size(); first = end) {
    while (end < pieces.size() && end - first < maxPiecesTogether && pieces[end]->texel == pieces[first]->texel) ++end;
    const std::size_t begin = raySource.slabs.size();
    const double area = appendSlabs(pieces.subspan(first, end - first), raySource);
    appendRange(raySource.texels, area, sum, begin, raySource.slabs.size());
  }
  return sum;
}

Choice chooseRange(std::span<const ShootingRange> ranges, double x) {
  return choose(ranges, x, [](const ShootingRange& range) { return range.upTo; });
}

template <typename Member>
std::span<const Member> membersOf(const ShootingRange& range, const std::vector<Member>& members) {
  return std::span(members).subspan(range.begin, range.end - range.begin);
}

/// The place in [0, 1] with the share x of the integral of a density from `left` to `right`, linear in between.
double placeOnLine(double left, double right, double x) {
  const double both = left + std::sqrt((1 - x) * left * left + x * right * right);
  return both > 0 ? x * (left + right) / both : 0;  // the left end of a triangle is a point
}

}  // namespace

RaySource pointRaySource(const radiosity::Scene& scene, std::uint32_t surface, const radiosity::SurfacePoint& point) {
  const auto [a, b, c] = inFrame(scene, scene.surfaces[surface].triangles[point.triangle]);
  const glm::dvec3 near = inFrame(scene, point.position);
  const glm::dvec3 inPlane = near - glm::dot(near - a, point.normal) * point.normal;
  const glm::dvec3 inward = (a + b + c) / 3.0 - inPlane;
  const double distance = glm::length(inward);
  const glm::dvec3 start = inPlane + (distance > 0 ? std::min(0.5, moveIntoTriangle / distance) : 0) * inward;
  const std::vector<ShootingRange> one{{.upTo = 1, .begin = 0, .end = 1}};
  return {one,
          one,
          one,
          {{{start, start}, {start, start}, {1, 1}, point.normal, numberInScene(scene, surface, point.triangle)}}};
}

RaySource areaRaySource(const SurfacePieces& pieces, std::span<const std::uint32_t> elements) {
  std::vector<const SurfacePiece*> sorted;
  for (const std::uint32_t element : elements)
    for (const SurfacePiece& piece : pieces.of(element)) sorted.push_back(&piece);
  const auto columnOf = [](const SurfacePiece* piece) { return std::pair{piece->surface, piece->texel.x}; };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const SurfacePiece* a, const SurfacePiece* b) {
    return std::pair{columnOf(a), a->texel.y} < std::pair{columnOf(b), b->texel.y};
  });
  RaySource raySource;
  double sum = 0;
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto end = std::find_if(first, sorted.end(),
                                  [&](const SurfacePiece* piece) { return columnOf(piece) != columnOf(*first); });
    const std::size_t begin = raySource.texels.size();
    const double area = appendTexels(Pieces(&*first, static_cast<std::size_t>(end - first)), raySource);
    appendRange(raySource.columns, area, sum, begin, raySource.texels.size());
    first = end;
  }
  assert(sum > 0);
  return raySource;
}

std::vector<std::uint32_t> elementsOfSurface(const radiosity::Discretization& discretization, std::uint32_t surface) {
  std::vector<std::uint32_t> elements(discretization.grids[surface].elementCount);
  std::iota(elements.begin(), elements.end(), discretization.grids[surface].firstElement);
  return elements;
}

ShootingPoint shootingPoint(const RaySource& raySource, double x, double y) {
  const std::span<const ShootingRange> columns(raySource.columns);
  const Choice column = chooseRange(columns, x);
  const std::span texels = membersOf(columns[column.index], raySource.texels);
  const Choice texel = chooseRange(texels, y);
  const std::span slabs = membersOf(texels[texel.index], raySource.slabs);
  const Choice slab = chooseRange(slabs, column.within);
  const std::span trapezoids = membersOf(slabs[slab.index], raySource.trapezoids);
  const std::array<double, 2>& whole = trapezoids.back().upTo;
  const double along = placeOnLine(whole[0], whole[1], slab.within);
  const Choice chosen = choose(trapezoids, texel.within, [along](const ShootingTrapezoid& trapezoid) {
    return glm::mix(trapezoid.upTo[0], trapezoid.upTo[1], along);
  });
  const ShootingTrapezoid& trapezoid = trapezoids[chosen.index];
  return {glm::mix(glm::mix(trapezoid.low[0], trapezoid.low[1], along),
                   glm::mix(trapezoid.high[0], trapezoid.high[1], along), chosen.within),
          trapezoid.normal, trapezoid.triangle};
}

}  // namespace hemitex::reference
