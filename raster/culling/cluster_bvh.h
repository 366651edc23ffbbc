/// A bounding volume hierarchy over clusters: groups of eight clusters in draw order, boxes around eight groups, and so
/// on. A face, or a part of one, visits only groups that it may show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/culling/frustum_culling.h"
#include "raster/culling/triangle_cluster.h"

namespace hemitex::raster {

/// The clusters [first, end).
struct ClusterGroup {
  std::uint32_t first = 0, end = 0;
  Box box;  ///< around all of them
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
  std::vector<std::vector<Box>>
      levels_;  ///< boxes of the groups, then boxes around eight boxes, up to one box; empty without groups
};

}  // namespace hemitex::raster
