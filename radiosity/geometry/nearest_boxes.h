/// A bounding volume hierarchy over boxes, for the nearest of objects that they enclose, and for those in a region. A
/// search visits few of the boxes that are farther away than the nearest object, or outside the region.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// All points from `low` to `high`, borders included.
struct SpaceBox {
  glm::dvec3 low{0.0}, high{0.0};
};

/// The squared distance from a point to a box; 0 inside.
inline double squaredDistance(const glm::dvec3& point, const SpaceBox& box) {
  const glm::dvec3 offset = point - glm::clamp(point, box.low, box.high);
  return glm::dot(offset, offset);
}

class NearestBoxes {
 public:
  /// The number of a box is its place in the list. Takes O(n log n) time.
  explicit NearestBoxes(std::span<const SpaceBox> boxes);

  /// Calls visitor(number, limit) for all boxes whose squared distance from a point is below `limit` and some others,
  /// approximately in order of distance. The callback may reduce `limit`.
  template <typename Visitor>
  void visit(const glm::dvec3& point, double& limit, const Visitor& visitor) const {
    if (!nodes_.empty()) visitNode(0, point, limit, visitor);
  }
  /// Whether isWanted(number) is true for a box. Boxes in larger ones for which meets(box) is false are not asked.
  template <typename Meets, typename IsWanted>
  bool any(const Meets& meets, const IsWanted& isWanted) const {
    return !nodes_.empty() && anyOf(0, meets, isWanted);
  }

 private:
  /// The first child of an inner node is the next node. A leaf has boxes instead.
  struct Node {
    SpaceBox box;
    std::uint32_t second = 0;  ///< the second child, or the first box in `order_`
    std::uint32_t boxes = 0;   ///< 0 for an inner node
  };

  void build(std::span<const SpaceBox> boxes, std::uint32_t begin, std::uint32_t end);

  template <typename Visitor>
  void visitNode(std::uint32_t number, const glm::dvec3& point, double& limit, const Visitor& visitor) const {
    const Node& node = nodes_[number];
    if (!(squaredDistance(point, node.box) < limit)) return;
    for (std::uint32_t i = node.second; i < node.second + node.boxes; ++i) visitor(order_[i], limit);
    if (node.boxes > 0) return;
    const std::uint32_t first = number + 1, second = node.second;
    const bool isFirstNearer = squaredDistance(point, nodes_[first].box) <= squaredDistance(point, nodes_[second].box);
    visitNode(isFirstNearer ? first : second, point, limit, visitor);
    visitNode(isFirstNearer ? second : first, point, limit, visitor);
  }

  template <typename Meets, typename IsWanted>
  bool anyOf(std::uint32_t number, const Meets& meets, const IsWanted& isWanted) const {
    const Node& node = nodes_[number];
    if (!meets(node.box)) return false;
    for (std::uint32_t i = node.second; i < node.second + node.boxes; ++i)
      if (isWanted(order_[i])) return true;
    return node.boxes == 0 && (anyOf(number + 1, meets, isWanted) || anyOf(node.second, meets, isWanted));
  }

  std::vector<Node> nodes_;           ///< the root is the first one
  std::vector<std::uint32_t> order_;  ///< boxes, leaf by leaf
};

}  // namespace hemitex::radiosity
