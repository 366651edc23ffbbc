#include "radiosity/scene/ray_tree.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t trianglesOfLeaf = 2;
/// Large triangles are separated down to this depth.
constexpr int maxDepthOfLarge = 16;
/// The cosine of the angle of a ray to a normal counts at least this much: rays along a plane leave it far away.
constexpr double minCosine = 1 / 64.0;

/// The distance at which a ray enters a box; infinity if it misses the box or enters it beyond `end`. `inverse` is 1
/// over the direction.
inline double entry(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& origin, const glm::dvec3& inverse,
                    double end) {
  const glm::dvec3 a = (low - origin) * inverse, b = (high - origin) * inverse;
  const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
  const double first = glm::max(glm::max(0.0, near.x), glm::max(near.y, near.z));
  const double last = glm::min(glm::min(end, far.x), glm::min(far.y, far.z));
  return first <= last ? first : std::numeric_limits<double>::infinity();
}

/// 1 over a direction; for 0 a large number instead of infinity, so that 0 times it is 0.
glm::dvec3 inverseOf(const glm::dvec3& direction) {
  const auto inverse = [](double x) { return x == 0 ? 1e300 : 1 / x; };
  return {inverse(direction.x), inverse(direction.y), inverse(direction.z)};
}

}  // namespace

RayTree::RayTree(const Scene& scene) : touching_(contactTolerance(scene)) {
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    for (std::uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t) {
      const auto& [a, b, c] = scene.surfaces[s].triangles[t].position;
      leaves_.push_back(
          {a, b - a, c - a, s, t, static_cast<std::uint32_t>(leaves_.size()), scene.surfaces[s].twin.has_value()});
    }
  if (!leaves_.empty()) build(0, static_cast<std::uint32_t>(leaves_.size()), 0);
}

void RayTree::build(std::uint32_t begin, std::uint32_t end, int depth) {
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  Node node;
  glm::dvec3 lowMiddle(std::numeric_limits<double>::infinity()), highMiddle(-lowMiddle);
  node.surface = leaves_[begin].surface;
  const auto middle = [](const Leaf& leaf) { return 3.0 * leaf.corner + leaf.along1 + leaf.along2; };
  for (std::uint32_t i = begin; i < end; ++i) {
    const Leaf& leaf = leaves_[i];
    if (leaf.surface != node.surface) node.surface = noSurface;
    for (const glm::dvec3& corner : {leaf.corner, leaf.corner + leaf.along1, leaf.corner + leaf.along2}) {
      node.low = glm::min(node.low, corner);
      node.high = glm::max(node.high, corner);
    }
    lowMiddle = glm::min(lowMiddle, middle(leaf));
    highMiddle = glm::max(highMiddle, middle(leaf));
  }
  if (end - begin <= trianglesOfLeaf) {
    node.second = begin;
    node.triangles = end - begin;
    nodes_[number] = node;
    return;
  }
  const glm::dvec3 size = highMiddle - lowMiddle;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto at = [&](std::uint32_t i) { return leaves_.begin() + i; };
  // Large triangles would make the boxes of all small ones beside them large.
  const auto isLarge = [&](const Leaf& leaf) {
    const glm::dvec3 extent = glm::max(glm::max(leaf.along1, leaf.along2), glm::dvec3(0)) -
                              glm::min(glm::min(leaf.along1, leaf.along2), glm::dvec3(0));
    return extent[axis] > (node.high[axis] - node.low[axis]) / 2;
  };
  std::uint32_t half =
      depth < maxDepthOfLarge ? static_cast<std::uint32_t>(std::partition(at(begin), at(end), isLarge) - at(0)) : begin;
  if (half == begin || half == end) {
    half = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(half), at(end),
                     [&](const Leaf& a, const Leaf& b) { return middle(a)[axis] < middle(b)[axis]; });
  }
  build(begin, half, depth + 1);
  node.second = static_cast<std::uint32_t>(nodes_.size());
  nodes_[number] = node;
  build(half, end, depth + 1);
}

template <typename Entry, typename Visit>
void RayTree::walk(double end, const Entry& entryOf, const Visit& visit) const {
  if (leaves_.empty()) return;
  struct Waiting {
    std::uint32_t node;
    double entry;
  };
  // Below maxDepthOfLarge the tree halves at each level, so its depth is at most that plus the number of bits of a
  // triangle count.
  std::array<Waiting, 64> waiting;
  std::size_t count = 0;
  const auto enter = [&](std::uint32_t node) { return Waiting{node, entryOf(nodes_[node], end)}; };
  waiting[count++] = enter(0);
  while (count > 0) {
    auto [number, entry] = waiting[--count];
    while (entry < end) {
      const Node& node = nodes_[number];
      if (node.triangles > 0) {
        for (std::uint32_t i = 0; i < node.triangles; ++i) visit(leaves_[node.second + i], end);
        break;
      }
      Waiting near = enter(number + 1), far = enter(node.second);
      if (far.entry < near.entry) std::swap(near, far);
      if (far.entry < end) waiting[count++] = far;
      number = near.node;
      entry = near.entry;
    }
  }
}

template <typename Meet>
void RayTree::trace(const glm::dvec3& origin, const glm::dvec3& direction, double end, const Meet& meet) const {
  const glm::dvec3 inverse = inverseOf(direction);
  walk(
      end, [&](const Node& node, double last) { return entry(node.low, node.high, origin, inverse, last); },
      [&](const Leaf& leaf, double& last) {
        // Moeller and Trumbore 1997.
        const glm::dvec3 p = glm::cross(direction, leaf.along2), offset = origin - leaf.corner;
        const double determinant = glm::dot(leaf.along1, p);
        if (determinant == 0) return;
        const double u = glm::dot(offset, p) / determinant;
        if (!(u >= 0 && u <= 1)) return;
        const glm::dvec3 q = glm::cross(offset, leaf.along1);
        const double v = glm::dot(direction, q) / determinant, t = glm::dot(leaf.along2, q) / determinant;
        if (leaf.hasTwin && determinant < 0) return;  // the twin shows its front there
        if (v >= 0 && u + v <= 1 && t > 0 && t < last)
          meet(TriangleHit{leaf.surface, leaf.triangle, {u, v}, t, determinant > 0}, leaf, last);
      });
}

std::optional<TriangleHit> RayTree::firstHit(const glm::dvec3& origin, const glm::dvec3& direction) const {
  std::optional<TriangleHit> front, back;
  double reach = 0;  // how far the ray goes beyond the front until the touching distance from its plane
  trace(origin, direction, std::numeric_limits<double>::infinity(),
        [&](const TriangleHit& hit, const Leaf& leaf, double& end) {
          std::optional<TriangleHit>& nearest = hit.isFront ? front : back;
          if (nearest && nearest->distance <= hit.distance) return;
          nearest = hit;
          if (!hit.isFront) {
            end = std::min(end, hit.distance);
            return;
          }
          const glm::dvec3 normal = glm::normalize(glm::cross(leaf.along1, leaf.along2));
          reach = touching_ / std::max(-glm::dot(normal, direction), minCosine * glm::length(direction));
          end = std::min(end, hit.distance + reach);
        });
  return back && (!front || back->distance <= front->distance + reach) ? back : front;
}

void RayTree::appendNear(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& numbers,
                         std::uint32_t except) const {
  const auto isNear = [&](const glm::dvec3& otherLow, const glm::dvec3& otherHigh) {
    return otherLow.x <= high.x && otherLow.y <= high.y && otherLow.z <= high.z && otherHigh.x >= low.x &&
           otherHigh.y >= low.y && otherHigh.z >= low.z;
  };
  walk(
      1,
      [&](const Node& node, double end) {
        const bool isLeftOut = except != noSurface && node.surface == except;
        return !isLeftOut && isNear(node.low, node.high) ? 0 : end;
      },
      [&](const Leaf& leaf, double&) {
        if (leaf.surface == except) return;
        const glm::dvec3 b = leaf.corner + leaf.along1, c = leaf.corner + leaf.along2;
        if (isNear(glm::min(glm::min(leaf.corner, b), c), glm::max(glm::max(leaf.corner, b), c)))
          numbers.push_back(leaf.number);
      });
}

bool RayTree::meetsBack(const glm::dvec3& origin, const glm::dvec3& direction, double distance, double cosine) const {
  bool isFound = false;
  trace(origin, direction, distance, [&](const TriangleHit& hit, const Leaf& leaf, double& end) {
    const glm::dvec3 normal = glm::normalize(glm::cross(leaf.along1, leaf.along2));
    if (hit.isFront || glm::dot(normal, direction) < cosine * glm::length(direction)) return;
    isFound = true;
    end = 0;
  });
  return isFound;
}

}  // namespace hemitex::radiosity
