/// Cluster meshes: the triangles of each cluster with the cluster's own vertices, each vertex once. So a face
/// transforms a vertex once, not once per triangle, and several vertices at a time (kernels.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/culling/triangle_cluster.h"
#include "raster/interface/draw_list.h"

namespace hemitex::raster {

/// Kernels process up to this number of vertices or triangles at a time.
inline constexpr std::size_t maxVertexLanes = 8;

/// One cluster of a mesh.
struct ClusterPart {
  std::uint32_t firstVertex, vertices;
  std::uint32_t firstTriangle, triangles;
};

struct ClusterMesh {
  std::vector<ClusterPart> parts;               ///< one per cluster
  std::array<std::vector<float>, 3> positions;  ///< x, y and z of the vertices, part by part
  std::vector<glm::vec2> texcoords;             ///< of the vertices
  /// Per triangle: its vertices, counted from the first vertex of the part.
  std::array<std::vector<std::uint8_t>, 3> corners;
  std::vector<std::uint32_t> draws;  ///< of the triangles
};

/// Makes the mesh. Its arrays are padded at the end, because kernels read several values at a time.
ClusterMesh meshOf(const DrawList& list, std::span<const Cluster> clusters);

}  // namespace hemitex::raster
