/// Clusters: short runs of triangles with a bounding box. If the box is outside the view of a face, its triangles need
/// no vertex stage, and no pixel changes. So drawing a narrow scissor rectangle is cheap.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "raster/culling/frustum_culling.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Maximum number of triangles per cluster. Larger clusters have large boxes; smaller ones are too many.
inline constexpr std::uint32_t largestCluster = 32;

struct Cluster {
  /// Runs of consecutive draws that are neighbours: the diagonal of the box is at most the sum of those of the runs.
  std::vector<TriangleRun> runs;
  Box box;  ///< around its vertices; infinite also if a texture coordinate is not finite
  std::optional<int> indexMap =
      {};  ///< of the draws that have one; draws with different maps are in different clusters
};

std::uint32_t triangleCount(const Cluster& cluster);

/// The `t`th triangle of a cluster, as a run.
TriangleRun triangleOf(const Cluster& cluster, std::uint32_t t);

/// Divides the draws into clusters, in draw order. The list must be valid.
std::vector<Cluster> clustersOf(const DrawList& list);

/// The smallest rectangle inside the scissor rectangle of the face that holds all samples that the clusters may cover.
/// Its width and height are 0 if there are none.
Scissor coveredBounds(const DrawList& list, std::span<const Cluster> clusters, const Face& face);

}  // namespace hemitex::raster
