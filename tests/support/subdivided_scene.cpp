#include "tests/support/subdivided_scene.h"

#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

namespace hemitex::tests {
namespace {

using radiosity::Triangle;

/// A triangle of the result so far, and the index of its successor.
struct Piece {
  Triangle triangle;
  std::size_t surface = 0;
  std::size_t next = 0;
};
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

std::vector<Piece> piecesOf(const radiosity::Scene& scene) {
  std::vector<Piece> pieces;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    for (const Triangle& triangle : scene.surfaces[s].triangles) pieces.push_back({triangle, s, pieces.size() + 1});
  pieces.back().next = none;
  return pieces;
}

/// The longest edge of a piece: from `corner` to the next corner. Pieces that share an edge compute the same length and
/// middle, so that they are consecutive in the order of bisections.
struct LongestEdge {
  double squaredLength = 0;
  glm::dvec3 middle;
  std::size_t piece = 0;
  std::size_t corner = 0;

  bool isSameAs(const LongestEdge& other) const {
    return squaredLength == other.squaredLength && middle == other.middle;
  }
  bool operator<(const LongestEdge& other) const {
    const auto key = [](const LongestEdge& e) {
      return std::make_tuple(e.squaredLength, e.middle.x, e.middle.y, e.middle.z, e.piece);
    };
    return key(*this) < key(other);
  }
};

template <typename T>
T between(const T& a, const T& b) {
  return 0.5 * (a + b);
}

LongestEdge longestEdge(const Triangle& triangle, std::size_t piece) {
  LongestEdge longest;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &a = triangle.position[k], &b = triangle.position[(k + 1) % 3];
    const LongestEdge edge{glm::dot(b - a, b - a), between(a, b), piece, k};
    if (longest < edge) longest = edge;
  }
  return longest;
}

glm::dvec2 onChartGrid(const glm::dvec2& chart) {
  const auto rounded = [](double x) { return std::nearbyint(x * 0x1p24) * 0x1p-24; };
  return {rounded(chart.x), rounded(chart.y)};
}

/// The half of a triangle with corner `kept`: corner `moved` moves to the middle of the edge between both.
Triangle half(Triangle triangle, std::size_t kept, std::size_t moved) {
  triangle.position[moved] = between(triangle.position[kept], triangle.position[moved]);
  triangle.chart[moved] = onChartGrid(between(triangle.chart[kept], triangle.chart[moved]));
  triangle.texcoord[moved] = between(triangle.texcoord[kept], triangle.texcoord[moved]);
  return triangle;
}

}  // namespace

radiosity::Scene finerScene(const radiosity::Scene& scene, std::size_t triangles) {
  std::vector<Piece> pieces = piecesOf(scene);
  std::priority_queue<LongestEdge> edges;
  for (std::size_t p = 0; p < pieces.size(); ++p) edges.push(longestEdge(pieces[p].triangle, p));
  LongestEdge last;
  while (pieces.size() < triangles || edges.top().isSameAs(last)) {
    last = edges.top();
    edges.pop();
    Piece& first = pieces[last.piece];
    const std::size_t a = last.corner, b = (a + 1) % 3;
    const Piece second{half(first.triangle, b, a), first.surface, first.next};
    first = {half(first.triangle, a, b), first.surface, pieces.size()};
    edges.push(longestEdge(first.triangle, last.piece));
    edges.push(longestEdge(second.triangle, pieces.size()));
    pieces.push_back(second);
  }

  radiosity::Scene finer = scene;
  for (radiosity::Surface& surface : finer.surfaces) surface.triangles.clear();
  for (std::size_t p = 0; p != none; p = pieces[p].next)
    finer.surfaces[pieces[p].surface].triangles.push_back(pieces[p].triangle);
  return finer;
}

}  // namespace hemitex::tests
