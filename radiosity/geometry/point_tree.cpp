#include "radiosity/geometry/point_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t leafPoints = 8;

}  // namespace

PointTree::PointTree(std::span<const glm::dvec2> points)
    : points_(points), order_(points.size()), place_(points.size()), leaf_(points.size()) {
  if (points.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.push_back({.count = static_cast<std::uint32_t>(points.size())});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

/// Measures the bounds of a node, and divides it at the median of the longer side if it has many points.
void PointTree::split(std::uint32_t node) {
  const auto first = order_.begin() + nodes_[node].first;
  const std::uint32_t count = nodes_[node].count;
  nodes_[node].low = nodes_[node].high = points_[*first];
  for (std::uint32_t i = 0; i < count; ++i) {
    nodes_[node].low = glm::min(nodes_[node].low, points_[first[i]]);
    nodes_[node].high = glm::max(nodes_[node].high, points_[first[i]]);
  }
  if (count <= leafPoints) {
    for (std::uint32_t i = 0; i < count; ++i) {
      place_[first[i]] = nodes_[node].first + i;
      leaf_[first[i]] = node;
    }
    return;
  }
  const glm::dvec2 size = nodes_[node].high - nodes_[node].low;
  const int axis = size.x >= size.y ? 0 : 1;
  const std::uint32_t half = count / 2;
  std::nth_element(first, first + half, first + count, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
  });
  nodes_[node].child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({.first = nodes_[node].first, .count = half, .parent = node});
  nodes_.push_back({.first = nodes_[node].first + half, .count = count - half, .parent = node});
}

void PointTree::remove(std::uint32_t point) {
  const std::uint32_t leaf = leaf_[point];
  const std::uint32_t last = order_[nodes_[leaf].first + nodes_[leaf].count - 1];
  std::swap(order_[place_[point]], order_[place_[last]]);
  std::swap(place_[point], place_[last]);
  for (std::uint32_t node = leaf; node != 0; node = nodes_[node].parent) --nodes_[node].count;
  --nodes_[0].count;
  shrink(leaf);
}

void PointTree::shrink(std::uint32_t node) {
  Node& shrunk = nodes_[node];
  const glm::dvec2 low = shrunk.low, high = shrunk.high;
  shrunk.low = glm::dvec2(std::numeric_limits<double>::max());
  shrunk.high = glm::dvec2(std::numeric_limits<double>::lowest());
  const auto include = [&shrunk](const glm::dvec2& from, const glm::dvec2& to) {
    shrunk.low = glm::min(shrunk.low, from);
    shrunk.high = glm::max(shrunk.high, to);
  };
  if (shrunk.child == 0)
    for (std::uint32_t i = shrunk.first; i < shrunk.first + shrunk.count; ++i)
      include(points_[order_[i]], points_[order_[i]]);
  else
    for (const std::uint32_t child : {shrunk.child, shrunk.child + 1})
      if (nodes_[child].count > 0) include(nodes_[child].low, nodes_[child].high);
  if (node != 0 && (shrunk.low != low || shrunk.high != high)) shrink(shrunk.parent);
}

}  // namespace hemitex::radiosity
