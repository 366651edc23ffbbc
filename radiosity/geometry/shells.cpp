#include "radiosity/geometry/shells.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "radiosity/geometry/tangent_along.h"

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t none = UINT32_MAX;
/// By how much a winding number may differ from an integer: corners on the edges of others are rounded. Open shells are
/// farther off, by the share of a view that their holes fill.
constexpr double rounding = 1e-6;
/// The volume of a solid or a room in cubes of its size.
constexpr double smallestVolume = 1e-9;

/// A triangle at an edge, as a half-edge.
struct EdgeSide {
  double place;  ///< grows with the angle around the edge
  std::uint32_t halfEdge;
  bool isAlong;  ///< as the first half-edge of the edge; then the front looks towards larger places
};

/// From 0 to 4 with the angle, without trigonometry.
double placeOnSquare(double x, double y) {
  const double share = x / (std::abs(x) + std::abs(y));
  return y >= 0 ? 1 - share : 3 + share;
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
    return std::pair(a.place, a.halfEdge) < std::pair(b.place, b.halfEdge);
  });
  return sides;
}

/// Calls match(a, b) for the half-edges whose triangles bound a wedge behind their fronts. Wedges lie in each other as
/// brackets do; the second turn closes those that the first one leaves open.
template <typename Match>
void matchBacks(const std::vector<EdgeSide>& sides, const Match& match) {
  std::vector<std::uint32_t> open;
  std::vector<bool> isClosed(sides.size(), false);
  for (const bool isFirstTurn : {true, false})
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (!sides[i].isAlong) {
        if (isFirstTurn) open.push_back(sides[i].halfEdge);
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

/// The triangles of a shell.
struct Part {
  std::vector<std::uint32_t> triangles;
  bool hasBorder = false;
};

ShellKind kindOf(std::span<const TrianglePositions> triangles, const Part& part) {
  glm::dvec3 low = triangles[part.triangles.front()][0], high = low;
  for (const std::uint32_t t : part.triangles)
    for (const glm::dvec3& corner : triangles[t]) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  const glm::dvec3 middle = (low + high) / 2.0, size = high - low;
  const auto winding = [&](const glm::dvec3& eye) {
    double sum = 0;
    for (const std::uint32_t t : part.triangles) sum += spheres(triangles[t], eye);
    return sum;
  };
  // So the last digits of the arc tangents do not matter.
  if (part.hasBorder)
    for (const glm::dvec3& place : {glm::dvec3(0.73, 0.61, 0.57), glm::dvec3(-0.59, 0.67, -0.71)})
      if (const double w = winding(middle + place * glm::length(size)); std::abs(w - std::round(w)) > rounding)
        return ShellKind::Sheet;
  double volume = 0;
  for (const std::uint32_t t : part.triangles) {
    const auto& [a, b, c] = triangles[t];
    volume += glm::dot(a - middle, glm::cross(b - middle, c - middle)) / 6;
  }
  const double length = glm::length(size);
  if (std::abs(volume) <= smallestVolume * length * length * length) return ShellKind::Sheet;
  return volume > 0 ? ShellKind::Solid : ShellKind::Room;
}

}  // namespace

Shells findShells(std::span<const TrianglePositions> triangles) {
  const MeshEdges edges = findEdges(triangles);
  const std::vector<std::uint32_t> across = acrossEdges(triangles, edges);
  boost::disjoint_sets_with_storage<> sets(triangles.size());
  for (std::uint32_t h = 0; h < across.size(); ++h)
    if (across[h] != none) sets.union_set(h / 3, across[h] / 3);
  // A neighbour that is turned over is across a border, too.
  std::vector<bool> hasBorder(triangles.size(), false);  // of each set, at its representative
  for (std::uint32_t h = 0; h < across.size(); ++h)
    if (across[h] == none || edges.vertex[across[h]] == edges.vertex[h]) hasBorder[sets.find_set(h / 3)] = true;
  std::vector<bool> isOpen(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) isOpen[t] = hasBorder[sets.find_set(t)];
  std::map<std::uint32_t, std::uint32_t> atVertex;  // a triangle with a border there
  for (std::uint32_t h = 0; h < across.size(); ++h) {
    if (across[h] != none) continue;
    for (const std::uint32_t vertex : {edges.vertex[h], edges.vertex[nextCorner(h)]})
      sets.union_set(atVertex.try_emplace(vertex, h / 3).first->second, h / 3);
  }
  Shells shells;
  std::vector<Part> parts;
  std::map<std::size_t, std::uint32_t> numbers;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [known, isNew] = numbers.try_emplace(sets.find_set(t), static_cast<std::uint32_t>(parts.size()));
    if (isNew) parts.emplace_back();
    shells.ofTriangle.push_back(known->second);
    parts[known->second].triangles.push_back(t);
    parts[known->second].hasBorder |= isOpen[t];
  }
  for (const Part& part : parts) shells.kinds.push_back(kindOf(triangles, part));
  return shells;
}

}  // namespace hemitex::radiosity
