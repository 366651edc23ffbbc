#include "radiosity/discretization/neighbours.h"

#include <algorithm>
#include <glm/glm.hpp>

#include "radiosity/geometry/mesh_edges.h"

namespace hemitex::radiosity {

std::vector<std::array<std::uint32_t, 3>> neighbours(const Surface& surface) {
  std::vector<TrianglePositions> positions;
  positions.reserve(surface.triangles.size());
  for (const Triangle& triangle : surface.triangles) positions.push_back(triangle.position);
  const MeshEdges edges = findEdges(positions);
  std::vector<std::array<std::uint32_t, 3>> result(surface.triangles.size(), {noNeighbour, noNeighbour, noNeighbour});
  for (std::uint32_t e = 0; e < edges.count(); ++e) {
    std::vector<std::uint32_t> opposite;
    for (const std::uint32_t h : edges.around(e)) opposite.push_back(nextCorner(nextCorner(h)));
    std::sort(opposite.begin(), opposite.end());  // a triangle without area may have the edge twice
    for (std::size_t i = 0; i < opposite.size() && opposite.size() > 1; ++i)
      result[opposite[i] / 3][opposite[i] % 3] = opposite[(i + 1) % opposite.size()] / 3;
  }
  return result;
}

std::size_t oppositeCorner(const Triangle& triangle, std::size_t corner, const Triangle& other) {
  const glm::dvec3 &a = triangle.position[(corner + 1) % 3], &b = triangle.position[(corner + 2) % 3];
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &c = other.position[(k + 1) % 3], &d = other.position[(k + 2) % 3];
    if ((a == c && b == d) || (a == d && b == c)) return k;
  }
  return 0;
}

}  // namespace hemitex::radiosity
