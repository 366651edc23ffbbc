#include "data/generate/seams.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemitex::data {
namespace {

/// In steps: two positions are at least a step apart or equal, up to the rounding of decimals.
constexpr double nearby = 1e-5;

bool before(const glm::dvec3& a, const glm::dvec3& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// All positions, each once, ordered by x.
std::vector<glm::dvec3> verticesOf(const std::vector<Group>& groups) {
  std::vector<glm::dvec3> vertices;
  for (const Group& group : groups)
    for (const Polygon& polygon : group.polygons)
      vertices.insert(vertices.end(), polygon.corners.begin(), polygon.corners.end());
  std::sort(vertices.begin(), vertices.end(), before);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// A vertex inside an edge, and its position along the edge, in (0, 1).
struct Between {
  double share = 0;
  glm::dvec3 position{0.0};
};

/// The vertices inside the edge from a to b, ordered from a to b.
std::vector<Between> insideEdge(const std::vector<glm::dvec3>& vertices, const glm::dvec3& a, const glm::dvec3& b,
                                double tolerance) {
  const auto leftOf = [](const glm::dvec3& vertex, double x) { return vertex.x < x; };
  const auto first = std::lower_bound(vertices.begin(), vertices.end(), std::min(a.x, b.x) - tolerance, leftOf);
  const auto last = std::lower_bound(vertices.begin(), vertices.end(), std::max(a.x, b.x) + tolerance, leftOf);
  const glm::dvec3 edge = b - a;
  std::vector<Between> result;
  for (auto vertex = first; vertex != last; ++vertex) {
    if (*vertex == a || *vertex == b) continue;
    const double share = glm::dot(*vertex - a, edge) / glm::dot(edge, edge);
    if (share > 0 && share < 1 && glm::distance(a + share * edge, *vertex) < tolerance)
      result.push_back({share, *vertex});
  }
  std::sort(result.begin(), result.end(), [](const Between& x, const Between& y) { return x.share < y.share; });
  return result;
}

/// The polygon with the vertices inside its edges as corners.
Polygon withVertices(const Polygon& polygon, const std::vector<glm::dvec3>& vertices, double tolerance) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.corners.size();
    const bool textured = !polygon.texcoords.empty();
    result.corners.push_back(polygon.corners[i]);
    if (textured) result.texcoords.push_back(polygon.texcoords[i]);
    for (const Between& between : insideEdge(vertices, polygon.corners[i], polygon.corners[next], tolerance)) {
      result.corners.push_back(between.position);
      if (!textured) continue;
      const glm::dvec2 exact = glm::mix(polygon.texcoords[i], polygon.texcoords[next], between.share);
      result.texcoords.push_back(glm::vec<2, double>(std::nearbyint(exact.x * 1e4), std::nearbyint(exact.y * 1e4)) /
                                 1e4);
    }
  }
  return result;
}

glm::dvec3 twiceArea(const Polygon& polygon) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 2; i < polygon.corners.size(); ++i)
    sum += glm::cross(polygon.corners[i - 1] - polygon.corners[0], polygon.corners[i] - polygon.corners[0]);
  return sum;
}

/// The corner of a polygon and its neighbours.
Polygon ear(const Polygon& polygon, std::size_t corner) {
  Polygon triangle;
  const std::size_t count = polygon.corners.size();
  for (const std::size_t i : {(corner + count - 1) % count, corner, (corner + 1) % count}) {
    triangle.corners.push_back(polygon.corners[i]);
    if (!polygon.texcoords.empty()) triangle.texcoords.push_back(polygon.texcoords[i]);
  }
  return triangle;
}

Polygon without(Polygon polygon, std::size_t corner) {
  polygon.corners.erase(polygon.corners.begin() + static_cast<std::ptrdiff_t>(corner));
  if (!polygon.texcoords.empty())
    polygon.texcoords.erase(polygon.texcoords.begin() + static_cast<std::ptrdiff_t>(corner));
  return polygon;
}

/// Twice the area of a triangle over its longest edge squared: 0 for collinear corners, at most 0.87.
double fatness(const Polygon& triangle) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 edge = triangle.corners[(i + 1) % 3] - triangle.corners[i];
    longest = std::max(longest, glm::dot(edge, edge));
  }
  return glm::length(twiceArea(triangle)) / longest;
}

/// Triangulates a convex polygon, which may have collinear corners, into triangles with area. Repeatedly cuts the
/// fattest ear that leaves a polygon with area.
std::vector<Polygon> triangulated(Polygon polygon) {
  std::vector<Polygon> triangles;
  while (polygon.corners.size() > 3) {
    std::size_t best = 0;
    double bestFatness = -1;
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const double rest = glm::length(twiceArea(without(polygon, i)));
      const double score = rest > 1e-6 * glm::length(twiceArea(polygon)) ? fatness(ear(polygon, i)) : -1;
      if (score > bestFatness + 1e-12) {
        best = i;
        bestFatness = score;
      }
    }
    triangles.push_back(ear(polygon, best));
    polygon = without(polygon, best);
  }
  triangles.push_back(polygon);
  return triangles;
}

}  // namespace

glm::dvec3 roundedPosition(const glm::dvec3& position, double steps) {
  return {std::nearbyint(position.x * steps) / steps, std::nearbyint(position.y * steps) / steps,
          std::nearbyint(position.z * steps) / steps};
}

void closeSeams(std::vector<Group>& groups, double steps) {
  for (Group& group : groups)
    for (Polygon& polygon : group.polygons)
      for (glm::dvec3& corner : polygon.corners) corner = roundedPosition(corner, steps);
  const std::vector<glm::dvec3> vertices = verticesOf(groups);
  for (Group& group : groups) {
    std::vector<Polygon> polygons;
    for (const Polygon& polygon : group.polygons) {
      const Polygon whole = withVertices(polygon, vertices, nearby / steps);
      if (whole.corners.size() == polygon.corners.size())
        polygons.push_back(polygon);
      else
        for (const Polygon& triangle : triangulated(whole)) polygons.push_back(triangle);
    }
    group.polygons = polygons;
  }
}

}  // namespace hemitex::data
