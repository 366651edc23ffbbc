/// Cluster meshes: the triangles of each cluster over vertices of its own, each vertex once. So a face places a vertex
/// once, not once a triangle, and many at a time (vertex_kernels.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/culling/triangle_cluster.h"
#include "raster/interface/draw_list.h"

namespace hemitex::raster {

/// Kernels work on up to so many vertices or triangles at a time.
inline constexpr std::size_t maxVertexLanes = 8;

/// One cluster of a mesh.
struct ClusterPart {
  std::uint32_t firstVertex, vertices;
  std::uint32_t firstTriangle, triangles;
};

struct ClusterMesh {
  std::vector<ClusterPart> parts;               ///< one a cluster
  std::array<std::vector<float>, 3> positions;  ///< x, y and z of the vertices, part by part
  std::vector<glm::vec2> texcoords;             ///< of the vertices
  /// Of the triangles: their vertices, counted from the part's first.
  std::array<std::vector<std::uint8_t>, 3> corners;
};

/// The arrays have room behind their ends for kernels that read many values at a time.
ClusterMesh meshOf(const DrawList& list, std::span<const Cluster> clusters);

}  // namespace hemitex::raster
