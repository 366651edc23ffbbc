#include "radiosity/geometry/nearest_boxes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t boxesOfLeaf = 8;

}  // namespace

NearestBoxes::NearestBoxes(std::span<const SpaceBox> boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

/// Divides boxes at the median of the axis along which their middles extend farthest.
void NearestBoxes::build(std::span<const SpaceBox> boxes, std::uint32_t begin, std::uint32_t end) {
  const auto doubledMiddle = [&](std::uint32_t box) { return boxes[box].low + boxes[box].high; };
  const std::size_t number = nodes_.size();
  nodes_.push_back({boxes[order_[begin]], begin, end - begin});
  SpaceBox middles{doubledMiddle(order_[begin]), doubledMiddle(order_[begin])};
  for (std::uint32_t i = begin; i < end; ++i) {
    const SpaceBox& box = boxes[order_[i]];
    nodes_[number].box = {glm::min(nodes_[number].box.low, box.low), glm::max(nodes_[number].box.high, box.high)};
    middles = {glm::min(middles.low, doubledMiddle(order_[i])), glm::max(middles.high, doubledMiddle(order_[i]))};
  }
  if (end - begin <= boxesOfLeaf) return;
  const glm::dvec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(doubledMiddle(a)[axis], a) < std::pair(doubledMiddle(b)[axis], b);
                   });
  build(boxes, begin, half);
  nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
  nodes_[number].boxes = 0;
  build(boxes, half, end);
}

}  // namespace hemitex::radiosity
