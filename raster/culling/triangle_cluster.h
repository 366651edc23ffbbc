/// Clusters: short runs of triangles and the boxes around them. Where a box lies outside of what a face shows, its
/// triangles need no vertex stage; no pixel can tell (raster rules, 3). So a narrow scissor rectangle costs little.
#pragma once

#include <span>
#include <vector>

#include "raster/culling/frustum_culling.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Triangles of one cluster, at most: boxes of more are wide, of fewer many.
inline constexpr std::uint32_t largestCluster = 32;

struct Cluster {
  /// Of one draw, or of several that follow each other and have no index map: pieces of a mesh, mostly neighbours.
  std::vector<TriangleRun> runs;
  Box box;  ///< around its vertices; infinite also where a texture coordinate is not finite
};

std::uint32_t triangleCount(const Cluster& cluster);

/// The `t`th triangle of a cluster, alone.
TriangleRun triangleOf(const Cluster& cluster, std::uint32_t t);

/// The draws cut into clusters, in draw order. The list is valid.
std::vector<Cluster> clustersOf(const DrawList& list);

/// The smallest rectangle inside the face's scissor rectangle that holds all samples that triangles of the clusters may
/// cover; without width and height where there are none.
Scissor coveredBounds(const DrawList& list, std::span<const Cluster> clusters, const Face& face);

}  // namespace hemitex::raster
