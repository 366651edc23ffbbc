/// A k-d tree of points in the plane, from which points can be removed. A search for a point in a small region visits
/// few of the others.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace hemitex::radiosity {

class PointTree {
 public:
  /// The points must outlive the tree.
  explicit PointTree(std::span<const glm::dvec2> points);

  /// Removes a point, given by its index, which must be in the tree.
  void remove(std::uint32_t point);

  /// Returns the index of a point for which `isInside(point)` holds; nothing if there is none. `mayMeet(low, high)`
  /// must hold for each box that contains such a point.
  template <typename MayMeet, typename IsInside>
  std::optional<std::uint32_t> find(const MayMeet& mayMeet, const IsInside& isInside) const {
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (node.count == 0 || !mayMeet(node.low, node.high)) continue;
      if (node.child == 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          if (mayMeet(points_[order_[i]], points_[order_[i]]) && isInside(order_[i])) return order_[i];
      } else {
        open.push_back(node.child + 1);
        open.push_back(node.child);
      }
    }
    return std::nullopt;
  }

 private:
  struct Node {
    glm::dvec2 low{0.0}, high{0.0};  ///< the bounds of its points
    std::uint32_t first = 0;         ///< of a leaf: its first point in `order_`
    std::uint32_t count = 0;         ///< its points that are not removed; in a leaf they come first
    std::uint32_t child = 0;         ///< the first of two children; 0 for a leaf
    std::uint32_t parent = 0;
  };

  void split(std::uint32_t node);
  void shrink(std::uint32_t node);

  std::span<const glm::dvec2> points_;
  std::vector<Node> nodes_;           ///< the root is the first one
  std::vector<std::uint32_t> order_;  ///< points, leaf by leaf
  std::vector<std::uint32_t> place_;  ///< per point: where it is in `order_`
  std::vector<std::uint32_t> leaf_;   ///< per point: its leaf
};

}  // namespace hemitex::radiosity
