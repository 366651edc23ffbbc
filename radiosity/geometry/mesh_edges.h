/// The edges of a triangle mesh: which triangles share an edge, found from equal positions.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

using TrianglePositions = std::array<glm::dvec3, 3>;

/// Half-edge 3t + k runs from corner k of triangle t to the next corner.
inline std::uint32_t nextCorner(std::uint32_t halfEdge) { return halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1; }

/// The half-edges of each edge, of both directions.
struct MeshEdges {
  std::vector<std::uint32_t> vertex;     ///< of each corner; equal positions have the same vertex
  std::vector<std::uint32_t> edge;       ///< of each half-edge
  std::vector<std::uint32_t> first;      ///< of each edge, in halfEdges; one more at the end
  std::vector<std::uint32_t> halfEdges;  ///< edge by edge, ascending

  std::size_t count() const { return first.size() - 1; }
  std::span<const std::uint32_t> around(std::uint32_t e) const {
    return std::span(halfEdges).subspan(first[e], first[e + 1] - first[e]);
  }
};

/// Takes n log n time in the number of triangles, which is at most 2^30.
MeshEdges findEdges(std::span<const TrianglePositions> triangles);

/// Whether something connects the triangles of two half-edges of the same edge.
using Connects = std::function<bool(std::uint32_t halfEdge, std::uint32_t other)>;

/// The triangles of a mesh, divided into sets. `owner` is the number of each triangle's set.
struct TriangleSets {
  std::vector<std::uint32_t> owner;
  std::vector<std::vector<std::uint32_t>> triangles;  ///< ordered by their first triangles, ascending
};

/// The triangles that edges connect. Of more than two triangles at an edge, only the first one of a set is asked
/// whether it connects to the others.
TriangleSets connectedSets(const MeshEdges& edges, const Connects& connects);

/// Grows sets of connected triangles, each triangle in one set at most.
class SetGrower {
 public:
  static constexpr std::uint32_t none = UINT32_MAX;  ///< the owner of a free triangle

  explicit SetGrower(const MeshEdges& edges)
      : edges_(edges), owner_(edges.edge.size() / 3, none), crossedBy_(edges.count(), none) {}

  /// Gives the free triangle `seed`, and the free ones connected to it, to the set `number`, which is new. Returns
  /// them, ascending.
  std::vector<std::uint32_t> grow(std::uint32_t seed, std::uint32_t number, const Connects& connects);

  bool isFree(std::uint32_t triangle) const { return owner_[triangle] == none; }
  void setOwner(std::uint32_t triangle, std::uint32_t number) { owner_[triangle] = number; }
  const std::vector<std::uint32_t>& owners() const { return owner_; }

 private:
  const MeshEdges& edges_;
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint32_t> crossedBy_;  ///< for each edge the last set that grew over it
};

}  // namespace hemitex::radiosity
