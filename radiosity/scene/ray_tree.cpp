#include "radiosity/scene/ray_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t trianglesOfLeaf = 2;
/// The cosine of the angle of a ray to a normal counts at least this much: rays along a plane leave it far away.
constexpr double minCosine = 1 / 64.0;
/// Nodes are divided at the cheapest of this number of planes per axis down to this depth, then in halves.
constexpr std::size_t bins = 16;
constexpr int maxDepthOfBins = 32;

/// The expected cost of the rays through a node: its surface area times its triangles (Goldsmith and Salmon 1987).
double costOf(const Bounds& bounds, std::uint32_t triangles) {
  if (triangles == 0) return 0;
  const glm::dvec3 size = bounds.high - bounds.low;
  return triangles * (size.x * size.y + size.y * size.z + size.z * size.x);
}

/// Triangles whose middles lie between two planes.
struct Bin {
  Bounds bounds;
  std::uint32_t triangles = 0;

  void include(const Bin& other) {
    bounds.include(other.bounds);
    triangles += other.triangles;
  }
};
using Bins = std::array<Bin, bins>;

/// A plane between the bins of an axis: triangles of the bins before `firstBin` and of the others.
struct Split {
  int axis = 0;
  std::size_t firstBin = 0;  ///< 0: no plane separates the triangles
  double cost = std::numeric_limits<double>::infinity();
};

/// Replaces `best` by the cheapest plane of an axis if that is cheaper.
void improve(const Bins& binsOfAxis, int axis, Split& best) {
  std::array<double, bins> costBefore;
  Bin before, behind;
  for (std::size_t b = 0; b < bins; ++b) {
    costBefore[b] = costOf(before.bounds, before.triangles);
    before.include(binsOfAxis[b]);
  }
  for (std::size_t b = bins - 1; b > 0; --b) {
    behind.include(binsOfAxis[b]);
    if (behind.triangles == 0 || behind.triangles == before.triangles) continue;
    const double cost = costBefore[b] + costOf(behind.bounds, behind.triangles);
    if (cost < best.cost) best = {axis, b, cost};
  }
}

/// A ray, with 1 over its direction, and for each axis the corner of boxes that it passes first: 0 for low, 1 for high.
struct BoxRay {
  glm::dvec3 origin, inverse;
  std::array<std::size_t, 3> first;

  BoxRay(const glm::dvec3& from, const glm::dvec3& inverseDirection) : origin(from), inverse(inverseDirection) {
    for (int axis = 0; axis < 3; ++axis) first[static_cast<std::size_t>(axis)] = inverse[axis] < 0 ? 1 : 0;
  }

  /// The distance at which the ray enters a box; infinity if it misses the box or enters it beyond `end`.
  double entry(const std::array<glm::dvec3, 2>& corners, double end) const {
    const auto [x, y, z] = first;
    const glm::dvec3 near = (glm::dvec3(corners[x].x, corners[y].y, corners[z].z) - origin) * inverse;
    const glm::dvec3 far = (glm::dvec3(corners[1 - x].x, corners[1 - y].y, corners[1 - z].z) - origin) * inverse;
    const double enters = glm::max(glm::max(0.0, near.x), glm::max(near.y, near.z));
    const double leaves = glm::min(glm::min(end, far.x), glm::min(far.y, far.z));
    return enters <= leaves ? enters : std::numeric_limits<double>::infinity();
  }
};

/// 1 over a direction; for 0 a large number instead of infinity, so that 0 times it is 0.
glm::dvec3 inverseOf(const glm::dvec3& direction) {
  const auto inverse = [](double x) { return x == 0 ? 1e300 : 1 / x; };
  return {inverse(direction.x), inverse(direction.y), inverse(direction.z)};
}

}  // namespace

RayTree::RayTree(const Scene& scene) : touching_(contactTolerance(scene)) {
  const auto add = [&](const std::array<glm::dvec3, 3>& corners, const TrianglePlace& place, const Triangle& triangle,
                       bool isHidden) {
    const auto& [a, b, c] = corners;
    leaves_.push_back({a, b - a, c - a, place, static_cast<std::uint32_t>(leaves_.size()), triangle.isBacked,
                       scene.instances[place.instance].reflects(), triangle.shell, isHidden,
                       isHidden ? nullptr : holedTriangle(scene, place)});
  };
  forEachPlace(scene, [&](const TrianglePlace& place) {
    add(placedCorners(scene, place), place, scene.surfaces[place.surface].triangles[place.triangle], false);
  });
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    for (const Triangle& triangle : scene.covered)
      add(placed(triangle, scene.instances[i]).position, {i, noSurface, 0}, triangle, true);
  if (!leaves_.empty()) build(0, static_cast<std::uint32_t>(leaves_.size()), 0);
}

/// Divides triangles at the plane with the smallest expected cost (Wald 2007), or in halves.
void RayTree::build(std::uint32_t begin, std::uint32_t end, int depth) {
  const auto middle = [](const Leaf& leaf) { return 3.0 * leaf.corner + leaf.along1 + leaf.along2; };
  const auto boundsOf = [](const Leaf& leaf) {
    Bounds bounds;
    for (const glm::dvec3& corner : {leaf.corner, leaf.corner + leaf.along1, leaf.corner + leaf.along2})
      bounds.include(corner);
    return bounds;
  };
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  Bounds bounds, middles;
  std::uint32_t surface = leaves_[begin].firstSurface();
  for (std::uint32_t i = begin; i < end; ++i) {
    bounds.include(boundsOf(leaves_[i]));
    middles.include(middle(leaves_[i]));
    if (leaves_[i].firstSurface() != surface) surface = noSurface;
  }
  nodes_[number] = {{bounds.low, bounds.high}, begin, end - begin, surface};
  if (end - begin <= trianglesOfLeaf) return;
  const glm::dvec3 size = middles.high - middles.low;
  const glm::dvec3 binsPerLength = static_cast<double>(bins) / size;
  const auto binOf = [&](const Leaf& leaf, int axis) {
    return std::min(static_cast<std::size_t>((middle(leaf)[axis] - middles.low[axis]) * binsPerLength[axis]), bins - 1);
  };
  Split split;
  for (int axis = 0; axis < 3 && depth < maxDepthOfBins; ++axis) {
    if (!std::isfinite(binsPerLength[axis])) continue;
    Bins ofAxis;
    for (std::uint32_t i = begin; i < end; ++i) ofAxis[binOf(leaves_[i], axis)].include({boundsOf(leaves_[i]), 1});
    improve(ofAxis, axis, split);
  }
  const auto at = [&](std::uint32_t i) { return leaves_.begin() + i; };
  std::uint32_t half = begin + (end - begin) / 2;
  if (split.firstBin > 0) {
    const auto isBefore = [&](const Leaf& leaf) { return binOf(leaf, split.axis) < split.firstBin; };
    half = static_cast<std::uint32_t>(std::partition(at(begin), at(end), isBefore) - at(0));
  } else {
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(at(begin), at(half), at(end),
                     [&](const Leaf& a, const Leaf& b) { return middle(a)[axis] < middle(b)[axis]; });
  }
  build(begin, half, depth + 1);
  nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
  nodes_[number].triangles = 0;
  build(half, end, depth + 1);
}

template <typename Entry, typename Visit>
void RayTree::walk(double end, const Entry& entryOf, const Visit& visit) const {
  if (leaves_.empty()) return;
  struct Waiting {
    std::uint32_t node;
    double entry;
  };
  // Below maxDepthOfBins the tree halves at each level, so its depth is at most that plus the number of bits of a
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
void RayTree::trace(const glm::dvec3& origin, const glm::dvec3& direction, double end, const Meet& meet,
                    std::uint32_t except) const {
  const BoxRay ray(origin, inverseOf(direction));
  walk(
      end,
      [&](const Node& node, double last) {
        const bool isLeftOut = except != noSurface && node.surface == except;
        return isLeftOut ? std::numeric_limits<double>::infinity() : ray.entry(node.corners, last);
      },
      [&](const Leaf& leaf, double& last) {
        if (except != noSurface && leaf.firstSurface() == except) return;
        // Moeller and Trumbore 1997.
        const glm::dvec3 p = glm::cross(direction, leaf.along2), offset = origin - leaf.corner;
        const double determinant = glm::dot(leaf.along1, p);
        if (determinant == 0) return;
        const double u = glm::dot(offset, p) / determinant;
        if (!(u >= 0 && u <= 1)) return;
        const glm::dvec3 q = glm::cross(offset, leaf.along1);
        const double v = glm::dot(direction, q) / determinant, t = glm::dot(leaf.along2, q) / determinant;
        if (v >= 0 && u + v <= 1 && t > 0 && t < last &&
            !(leaf.holed && isHole(*leaf.holed->cutOut, leaf.holed->triangle, glm::dvec2(u, v))))
          meet(TriangleHit{.surface = leaf.place.surface,
                           .triangle = leaf.place.triangle,
                           .weights = leaf.isReflected ? glm::dvec2(v, u) : glm::dvec2(u, v),
                           .distance = t,
                           .isFront = determinant > 0,
                           .instance = leaf.place.instance,
                           .shell = leaf.shell},
               leaf, last);
      });
}

std::optional<TriangleHit> RayTree::firstHit(const glm::dvec3& origin, const glm::dvec3& direction,
                                             double distance) const {
  std::optional<TriangleHit> front, back;
  double reach = 0;  // how far the ray goes beyond the front until the touching distance from its plane
  trace(origin, direction, distance, [&](const TriangleHit& hit, const Leaf& leaf, double& end) {
    if (leaf.isHidden || (!hit.isFront && leaf.isBacked)) return;
    std::optional<TriangleHit>& nearest = hit.isFront ? front : back;
    const auto order = [](const TriangleHit& of) {
      return std::tuple(of.distance, of.instance, of.surface, of.triangle);
    };
    if (nearest && order(*nearest) <= order(hit)) return;
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

void RayTree::visitHits(const glm::dvec3& origin, const glm::dvec3& direction,
                        const std::function<void(const TriangleHit&)>& visit) const {
  trace(origin, direction, std::numeric_limits<double>::infinity(),
        [&](const TriangleHit& hit, const Leaf&, double&) { visit(hit); });
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
        return !isLeftOut && isNear(node.corners[0], node.corners[1]) ? 0 : end;
      },
      [&](const Leaf& leaf, double&) {
        if (leaf.isHidden || (except != noSurface && leaf.firstSurface() == except)) return;
        const glm::dvec3 b = leaf.corner + leaf.along1, c = leaf.corner + leaf.along2;
        if (isNear(glm::min(glm::min(leaf.corner, b), c), glm::max(glm::max(leaf.corner, b), c)))
          numbers.push_back(leaf.number);
      });
}

bool RayTree::isBlocked(const glm::dvec3& origin, const glm::dvec3& direction, double distance) const {
  bool isFound = false;
  trace(origin, direction, distance, [&](const TriangleHit& hit, const Leaf& leaf, double& end) {
    if (leaf.isHidden || (!hit.isFront && leaf.isBacked)) return;
    isFound = true;
    end = 0;
  });
  return isFound;
}

bool RayTree::meetsBack(const glm::dvec3& origin, const glm::dvec3& direction, double distance, double cosine,
                        std::uint32_t except) const {
  bool isFound = false;
  const auto meet = [&](const TriangleHit& hit, const Leaf& leaf, double& end) {
    const glm::dvec3 normal = glm::normalize(glm::cross(leaf.along1, leaf.along2));
    if (leaf.isHidden || hit.isFront || leaf.isBacked || glm::dot(normal, direction) < cosine * glm::length(direction))
      return;
    isFound = true;
    end = 0;
  };
  trace(origin, direction, distance, meet, except);
  return isFound;
}

}  // namespace hemitex::radiosity
