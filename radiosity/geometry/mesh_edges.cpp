#include "radiosity/geometry/mesh_edges.h"

#include <algorithm>
#include <utility>

namespace hemitex::radiosity {
namespace {

/// Sorts pairs of a key and an index. Gives equal keys the same number and different keys different numbers, by index.
template <typename Key>
std::vector<std::uint32_t> sortAndNumber(std::vector<std::pair<Key, std::uint32_t>>& keyed) {
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> numbers(keyed.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i > 0 && keyed[i - 1].first != keyed[i].first) ++number;
    numbers[keyed[i].second] = number;
  }
  return numbers;
}

std::vector<std::uint32_t> weld(std::span<const TrianglePositions> triangles) {
  std::vector<std::pair<std::array<double, 3>, std::uint32_t>> corners;
  corners.reserve(3 * triangles.size());
  for (const TrianglePositions& triangle : triangles)
    for (const glm::dvec3& p : triangle)
      corners.push_back({{p.x, p.y, p.z}, static_cast<std::uint32_t>(corners.size())});
  return sortAndNumber(corners);
}

}  // namespace

MeshEdges findEdges(std::span<const TrianglePositions> triangles) {
  MeshEdges edges;
  edges.vertex = weld(triangles);
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> halfEdges;
  halfEdges.reserve(edges.vertex.size());
  for (std::uint32_t h = 0; h < edges.vertex.size(); ++h)
    halfEdges.push_back({std::minmax(edges.vertex[h], edges.vertex[nextCorner(h)]), h});
  edges.edge = sortAndNumber(halfEdges);
  edges.halfEdges.reserve(halfEdges.size());
  for (std::uint32_t i = 0; i < halfEdges.size(); ++i) {
    edges.halfEdges.push_back(halfEdges[i].second);
    if (edges.edge[halfEdges[i].second] == edges.first.size()) edges.first.push_back(i);
  }
  edges.first.push_back(static_cast<std::uint32_t>(halfEdges.size()));
  return edges;
}

std::vector<std::uint32_t> SetGrower::grow(std::uint32_t seed, std::uint32_t number, const Connects& connects) {
  std::vector<std::uint32_t> found{seed};
  owner_[seed] = number;
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (std::uint32_t h = 3 * found[next]; h < 3 * found[next] + 3; ++h) {
      const std::uint32_t edge = edges_.edge[h];
      if (std::exchange(crossedBy_[edge], number) == number) continue;
      for (const std::uint32_t other : edges_.around(edge)) {
        if (!isFree(other / 3) || !connects(h, other)) continue;
        owner_[other / 3] = number;
        found.push_back(other / 3);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

TriangleSets connectedSets(const MeshEdges& edges, const Connects& connects) {
  TriangleSets sets;
  SetGrower grower(edges);
  for (std::uint32_t seed = 0; seed < edges.edge.size() / 3; ++seed)
    if (grower.isFree(seed))
      sets.triangles.push_back(grower.grow(seed, static_cast<std::uint32_t>(sets.triangles.size()), connects));
  sets.owner = grower.owners();
  return sets;
}

}  // namespace hemitex::radiosity
