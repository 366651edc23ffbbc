#include "raster/cluster_tree.h"

#include <algorithm>

namespace hemitex::raster {
namespace {

constexpr std::size_t fanOut = 8;

std::vector<Box> parentsOf(const std::vector<Box>& boxes) {
  std::vector<Box> parents;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % fanOut == 0) parents.push_back(boxes[i]);
    parents.back().low = glm::min(parents.back().low, boxes[i].low);
    parents.back().high = glm::max(parents.back().high, boxes[i].high);
  }
  return parents;
}

}  // namespace

ClusterTree::ClusterTree(std::span<const Cluster> clusters) {
  if (clusters.empty()) return;
  levels_.emplace_back();
  for (const Cluster& cluster : clusters) levels_.back().push_back(cluster.box);
  while (levels_.back().size() > 1) levels_.push_back(parentsOf(levels_.back()));
}

std::vector<std::uint32_t> ClusterTree::clustersIn(const ViewBounds& view) const {
  std::vector<std::uint32_t> found;
  if (!levels_.empty()) visit(levels_.size() - 1, 0, view, found);
  return found;
}

void ClusterTree::visit(std::size_t level, std::size_t node, const ViewBounds& view,
                        std::vector<std::uint32_t>& found) const {
  if (!view.mayShow(levels_[level][node])) return;
  if (level == 0) {
    found.push_back(static_cast<std::uint32_t>(node));
    return;
  }
  const std::size_t end = std::min((node + 1) * fanOut, levels_[level - 1].size());
  for (std::size_t child = node * fanOut; child < end; ++child) visit(level - 1, child, view, found);
}

}  // namespace hemitex::raster
