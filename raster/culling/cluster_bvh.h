/// A tree over clusters: groups of eight that follow each other in draw order, boxes around eight groups, and so on. A
/// face, or a part of one, looks only at groups that it may show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/culling/frustum_culling.h"
#include "raster/culling/triangle_cluster.h"

namespace hemitex::raster {

/// Clusters that follow each other: [first, end).
struct ClusterGroup {
  std::uint32_t first = 0, end = 0;
  Box box;  ///< around theirs
};

class ClusterBvh {
 public:
  ClusterBvh() = default;
  explicit ClusterBvh(std::span<const Cluster> clusters);

  /// The numbers of the groups that may cover a sample, in draw order.
  std::vector<std::uint32_t> groupsIn(const ViewBounds& view) const;
  const ClusterGroup& group(std::uint32_t number) const { return groups_[number]; }

 private:
  void visit(std::size_t level, std::size_t node, const ViewBounds& view, std::vector<std::uint32_t>& found) const;

  std::vector<ClusterGroup> groups_;
  std::vector<std::vector<Box>> levels_;  ///< the groups', then boxes of boxes; the last has one; none without groups
};

}  // namespace hemitex::raster
