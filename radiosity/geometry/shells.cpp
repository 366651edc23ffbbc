#include "radiosity/geometry/shells.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "radiosity/geometry/tangent_along.h"

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t none = UINT32_MAX;
/// By how much a winding number may differ from an integer: corners on the edges of others are rounded. Open shells are
/// farther off, by the share of a view that their holes fill.
constexpr double rounding = 1e-6;
/// The volume of a solid or a room in cubes of its size.
constexpr double minVolume = 1e-9;

/// A triangle at an edge, as a half-edge.
struct EdgeSide {
  double place;  ///< grows with the angle around the edge
  std::uint32_t halfEdge;
  bool isAlong;  ///< as the first half-edge of the edge; then the front looks towards larger places
};

/// From 0 to 4 with the angle, without trigonometry; rounded, so that triangles in one place have the same.
double placeOnSquare(double x, double y) {
  const double share = x / (std::abs(x) + std::abs(y));
  const double place = std::round((y >= 0 ? 1 - share : 3 + share) * 0x1p20) * 0x1p-20;
  return place == 4 ? 0 : place;
}

std::vector<EdgeSide> sidesAround(std::span<const TrianglePositions> triangles, const MeshEdges& edges,
                                  std::uint32_t edge) {
  const std::uint32_t first = edges.around(edge).front();
  const glm::dvec3 start = triangles[first / 3][first % 3];
  const glm::dvec3 axis = glm::normalize(triangles[first / 3][nextCorner(first) % 3] - start);
  const glm::dvec3 x = tangentAlong(axis, glm::dvec3(0)), y = glm::cross(axis, x);
  std::vector<EdgeSide> sides;
  for (const std::uint32_t h : edges.around(edge)) {
    const glm::dvec3 out = triangles[h / 3][nextCorner(nextCorner(h)) % 3] - start;
    sides.push_back({placeOnSquare(glm::dot(out, x), glm::dot(out, y)), h, edges.vertex[h] == edges.vertex[first]});
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return std::tuple(a.place, !a.isAlong, a.halfEdge) < std::tuple(b.place, !b.isAlong, b.halfEdge);
  });
  return sides;
}

/// Calls match(a, b) for the half-edges whose triangles bound a wedge behind their fronts. Wedges lie in each other as
/// brackets do; the second pass closes those that the first one leaves open. Wedges without an inside come last,
/// because the triangles in one place are sorted so that none closes what another one of them opens.
template <typename Match>
void matchBacks(const std::vector<EdgeSide>& sides, const Match& match) {
  std::vector<std::uint32_t> open;
  std::vector<bool> isClosed(sides.size(), false);
  for (const bool isFirstPass : {true, false})
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (!sides[i].isAlong) {
        if (isFirstPass) open.push_back(sides[i].halfEdge);
      } else if (!open.empty() && !isClosed[i]) {
        match(open.back(), sides[i].halfEdge);
        isClosed[i] = true;
        open.pop_back();
      }
    }
}

/// The half-edge across each half-edge, or none at a border.
std::vector<std::uint32_t> acrossEdges(std::span<const TrianglePositions> triangles, const MeshEdges& edges) {
  std::vector<std::uint32_t> across(edges.edge.size(), none);
  const auto match = [&](std::uint32_t a, std::uint32_t b) {
    across[a] = b;
    across[b] = a;
  };
  for (std::uint32_t e = 0; e < edges.count(); ++e) {
    const auto around = edges.around(e);
    if (around.size() == 2)
      match(around[0], around[1]);
    else if (around.size() > 2)
      matchBacks(sidesAround(triangles, edges, e), match);
  }
  return across;
}

/// The solid angle of a triangle in spheres, positive if its back is seen (Van Oosterom and Strackee 1983, eq. 8).
double spheres(const TrianglePositions& triangle, const glm::dvec3& eye) {
  const glm::dvec3 a = triangle[0] - eye, b = triangle[1] - eye, c = triangle[2] - eye;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::atan2(glm::dot(a, glm::cross(b, c)), below) / (2 * std::numbers::pi);
}

/// For each triangle, whether it looks the other way than most of the area that edges connect it to.
std::vector<bool> turnedOver(std::span<const TrianglePositions> triangles, const MeshEdges& edges,
                             const std::vector<std::uint32_t>& across) {
  std::vector<bool> isReached(triangles.size(), false), isTurned(triangles.size(), false);
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (isReached[seed]) continue;
    std::vector<std::uint32_t> found{seed};
    std::array<double, 2> area{0, 0};
    isReached[seed] = true;
    for (std::size_t next = 0; next < found.size(); ++next) {
      const std::uint32_t t = found[next];
      const auto& [a, b, c] = triangles[t];
      area[isTurned[t] ? 1 : 0] += glm::length(glm::cross(b - a, c - a));
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (across[h] == none || isReached[across[h] / 3]) continue;
        isReached[across[h] / 3] = true;
        isTurned[across[h] / 3] = isTurned[t] != (edges.vertex[across[h]] == edges.vertex[h]);
        found.push_back(across[h] / 3);
      }
    }
    if (area[1] > area[0])
      for (const std::uint32_t t : found) isTurned[t] = !isTurned[t];
  }
  return isTurned;
}

/// The triangles of a shell, and where it ends.
struct Part {
  std::vector<std::uint32_t> triangles = {};
  glm::dvec3 low, high;     ///< the box around it
  glm::dvec3 borders{0.0};  ///< the sum of the middles of borders, times their lengths
  double borderLength = 0;

  glm::dvec3 middle() const { return (low + high) / 2.0; }
  double size() const { return glm::length(high - low); }
};

/// The sum of a value of all triangles; of one that is turned over it counts with the other sign.
template <typename Value>
double sumOf(const Part& part, const std::vector<bool>& isTurnedOver, const Value& value) {
  double sum = 0;
  for (const std::uint32_t t : part.triangles) sum += (isTurnedOver[t] ? -1 : 1) * value(t);
  return sum;
}

bool isClosed(std::span<const TrianglePositions> triangles, const std::vector<bool>& isTurnedOver, const Part& part) {
  if (part.borderLength == 0) return true;
  // The bound is far above the rounding of arc tangents, which differs between machines.
  const std::array places{glm::dvec3(0.73, 0.61, 0.57), glm::dvec3(-0.59, 0.67, -0.71)};
  return std::all_of(places.begin(), places.end(), [&](const glm::dvec3& place) {
    const glm::dvec3 eye = part.middle() + part.size() * place;
    const double winding = sumOf(part, isTurnedOver, [&](std::uint32_t t) { return spheres(triangles[t], eye); });
    return std::abs(winding - std::round(winding)) <= rounding;
  });
}

double volumeOf(std::span<const TrianglePositions> triangles, const std::vector<bool>& isTurnedOver, const Part& part) {
  const glm::dvec3 apex = part.borderLength > 0 ? part.borders / part.borderLength : part.middle();
  return sumOf(part, isTurnedOver, [&](std::uint32_t t) {
    const auto& [a, b, c] = triangles[t];
    return glm::dot(a - apex, glm::cross(b - apex, c - apex)) / 6;
  });
}

ShellKind kindOf(double volume, const Part& part) {
  if (std::abs(volume) <= minVolume * part.size() * part.size() * part.size()) return ShellKind::Sheet;
  return volume > 0 ? ShellKind::Solid : ShellKind::Room;
}

}  // namespace

Shells findShells(std::span<const TrianglePositions> triangles) {
  const MeshEdges edges = findEdges(triangles);
  const std::vector<std::uint32_t> across = acrossEdges(triangles, edges);
  boost::disjoint_sets_with_storage<> sets(triangles.size());
  for (std::uint32_t h = 0; h < across.size(); ++h)
    if (across[h] != none) sets.union_set(h / 3, across[h] / 3);
  std::map<std::uint32_t, std::uint32_t> atVertex;  // a triangle with a border there
  for (std::uint32_t h = 0; h < across.size(); ++h) {
    if (across[h] != none) continue;
    for (const std::uint32_t vertex : {edges.vertex[h], edges.vertex[nextCorner(h)]})
      sets.union_set(atVertex.try_emplace(vertex, h / 3).first->second, h / 3);
  }
  Shells shells;
  shells.isTurnedOver = turnedOver(triangles, edges, across);
  std::vector<Part> parts;
  std::map<std::size_t, std::uint32_t> numbers;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [known, isNew] = numbers.try_emplace(sets.find_set(t), static_cast<std::uint32_t>(parts.size()));
    if (isNew) parts.push_back({.low = triangles[t][0], .high = triangles[t][0]});
    shells.ofTriangle.push_back(known->second);
    Part& part = parts[known->second];
    part.triangles.push_back(t);
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const glm::dvec3 &start = triangles[t][h % 3], &end = triangles[t][nextCorner(h) % 3];
      part.low = glm::min(part.low, start);
      part.high = glm::max(part.high, start);
      if (across[h] != none) continue;
      part.borders += glm::length(end - start) * (start + end) / 2.0;
      part.borderLength += glm::length(end - start);
    }
  }
  for (const Part& part : parts) {
    shells.volumes.push_back(volumeOf(triangles, shells.isTurnedOver, part));
    shells.kinds.push_back(kindOf(shells.volumes.back(), part));
    shells.isClosed.push_back(isClosed(triangles, shells.isTurnedOver, part));
  }
  return shells;
}

}  // namespace hemitex::radiosity
