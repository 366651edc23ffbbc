/// An R-tree of boxes in the plane, to which boxes can be added and from which they can be removed. A search visits few
/// of the boxes that do not meet the searched one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// All points from `low` to `high`, borders included.
struct PlaneBox {
  glm::dvec2 low{0.0}, high{0.0};
};

/// Whether two boxes have a common point.
inline bool meet(const PlaneBox& a, const PlaneBox& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

class BoxTree {
 public:
  /// The number of a box is its place in the list.
  explicit BoxTree(std::span<const PlaneBox> boxes);
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;
  BoxTree& operator=(BoxTree&&) noexcept;

  void add(const PlaneBox& box, std::uint32_t number);
  /// Removes a box with its number, which must be in the tree.
  void remove(const PlaneBox& box, std::uint32_t number);
  /// Replaces `found` by the numbers of the boxes that meet a box, ascending.
  void find(const PlaneBox& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::radiosity
