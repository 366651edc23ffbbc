/// A tree over clusters: boxes around eight that follow each other in draw order, around eight of these, and so on. A
/// face, or a part of one, looks only at clusters that it may show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/cluster.h"
#include "raster/view_bounds.h"

namespace hemitex::raster {

class ClusterTree {
 public:
  ClusterTree() = default;
  explicit ClusterTree(std::span<const Cluster> clusters);

  /// The clusters that may cover a sample, in draw order.
  std::vector<std::uint32_t> clustersIn(const ViewBounds& view) const;

 private:
  void visit(std::size_t level, std::size_t node, const ViewBounds& view, std::vector<std::uint32_t>& found) const;

  std::vector<std::vector<Box>>
      levels_;  ///< the clusters', then boxes of boxes; the last has one; none without clusters
};

}  // namespace hemitex::raster
