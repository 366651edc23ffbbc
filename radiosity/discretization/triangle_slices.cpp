#include "radiosity/discretization/triangle_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "radiosity/discretization/neighbours.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/geometry/mesh_charts.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Share of the tolerance; far above the rounding errors of slices.
constexpr double roundingShare = 0x1p-10;

/// A triangle with the constants for barycentric weights.
class WeightedTriangle {
 public:
  WeightedTriangle(const Triangle& triangle, double lift, double tolerance)
      : corner_(triangle.position[0]),
        along1_(triangle.position[1] - corner_),
        along2_(triangle.position[2] - corner_),
        normal_(glm::cross(along1_, along2_)),
        lift_(lift),
        tolerance_(tolerance) {
    const double doubledArea = glm::length(normal_);
    // heights of the corners above the opposite edges
    heights_ = {doubledArea / glm::length(along2_ - along1_), doubledArea / glm::length(along2_),
                doubledArea / glm::length(along1_)};
  }

  /// Height above the plane of the slices.
  double heightOf(const glm::dvec3& point) const {
    return glm::dot(point - corner_, normal_) / glm::length(normal_) - lift_;
  }

  glm::dvec2 weightsOf(const glm::dvec3& point) const { return weightsOfStep(point - corner_); }

  /// The change of weights from the crossing of a triangle with the plane of the slices to its crossing with the plane
  /// of this triangle. Zero if the two planes are parallel to within minSine.
  glm::dvec2 stepToSurface(const Triangle& triangle) const {
    constexpr double minSine = 1 / 256.0;
    const glm::dvec3 n = normal_ / glm::length(normal_), m = normal(triangle);
    // A direction in the triangle; its length is the sine of the angle between the planes.
    const glm::dvec3 down = glm::dot(m, n) * m - n;
    const double squaredSine = glm::dot(down, down);
    if (squaredSine < minSine * minSine) return glm::dvec2(0);
    return weightsOfStep(lift_ / squaredSine * down);
  }

  /// Whether the middle of this triangle lies on the plane of another that faces the other way.
  bool isBackToBackWith(const Triangle& other) const {
    const glm::dvec3 otherNormal =
        glm::cross(other.position[1] - other.position[0], other.position[2] - other.position[0]);
    const double lengths = glm::length(normal_) * glm::length(otherNormal);
    if (glm::dot(normal_, otherNormal) > -touchingCosine * lengths) return false;
    const glm::dvec3 middle = corner_ + (along1_ + along2_) / 3.0;
    return std::abs(glm::dot(middle - other.position[0], otherNormal)) <= 2 * lift_ * glm::length(otherNormal);
  }

  /// The part of a slice inside the triangle with edges moved outwards by `margin`, a length; nothing if it is shorter
  /// than the tolerance.
  std::optional<Slice> clipped(const Slice& slice, double margin) const {
    double first = 0, last = 1;
    const std::array<double, 3> from = allWeights(slice.from), to = allWeights(slice.to);
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = from[k] + margin / heights_[k], b = to[k] + margin / heights_[k];
      if (a < 0 && b < 0) return std::nullopt;
      if (a < 0) first = std::max(first, a / (a - b));
      if (b < 0) last = std::min(last, a / (a - b));
    }
    const glm::dvec2 step = slice.to - slice.from;
    if ((last - first) * glm::length(step.x * along1_ + step.y * along2_) <= tolerance_) return std::nullopt;
    return Slice{slice.from + first * step, slice.from + last * step};
  }

  /// The corner opposite to the edge that a slice lies along, if it does.
  std::optional<std::size_t> edgeAlong(const Slice& slice) const {
    const std::array<double, 3> from = allWeights(slice.from), to = allWeights(slice.to);
    for (std::size_t k = 0; k < 3; ++k)
      if (std::max(std::abs(from[k]), std::abs(to[k])) * heights_[k] <= 2 * tolerance_) return k;
    return std::nullopt;
  }

 private:
  glm::dvec2 weightsOfStep(const glm::dvec3& offset) const {
    const double scale = glm::dot(normal_, normal_);
    return {glm::dot(glm::cross(offset, along2_), normal_) / scale,
            glm::dot(glm::cross(along1_, offset), normal_) / scale};
  }

  static std::array<double, 3> allWeights(const glm::dvec2& weights) {
    return {1 - weights.x - weights.y, weights.x, weights.y};
  }

  glm::dvec3 corner_, along1_, along2_, normal_;
  double lift_, tolerance_;
  std::array<double, 3> heights_;
};

/// The segment in which a triangle crosses the slicing plane of another.
std::optional<Slice> sliceOf(const Triangle& triangle, const WeightedTriangle& plane) {
  std::array<double, 3> height;
  for (std::size_t k = 0; k < 3; ++k) height[k] = plane.heightOf(triangle.position[k]);
  std::array<glm::dvec2, 2> ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3 && count < 2; ++k) {
    const std::size_t next = (k + 1) % 3;
    if ((height[k] >= 0) == (height[next] >= 0)) continue;
    const double t = height[k] / (height[k] - height[next]);
    // Weights of both corners, not of a point between them: so the result is independent of the position of the scene.
    const glm::dvec2 from = plane.weightsOf(triangle.position[k]), to = plane.weightsOf(triangle.position[next]);
    ends[count++] = from + t * (to - from);
  }
  if (count < 2) return std::nullopt;
  const glm::dvec2 step = plane.stepToSurface(triangle);
  return Slice{ends[0] + step, ends[1] + step};
}

bool isBefore(const Slice& a, const Slice& b) {
  return std::tie(a.from.x, a.from.y, a.to.x, a.to.y) < std::tie(b.from.x, b.from.y, b.to.x, b.to.y);
}

/// The slices of the triangles of the first instance by all other triangles in space.
class Slicer {
 public:
  Slicer(const Scene& scene, const RayTree& tree)
      : scene_(scene), lift_(contactTolerance(scene)), tolerance_(outlineTolerance(scene)), tree_(tree) {
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      const Surface& surface = scene.surfaces[s];
      const std::uint32_t except = maySliceItself(surface) ? RayTree::noSurface : s;
      for (const Triangle& triangle : surface.triangles) owners_.push_back({&triangle, &surface, except});
    }
  }

  /// A slice along an edge of a triangle, and the number of the triangle that makes it.
  struct EdgeSlice {
    Slice slice;
    std::uint32_t other = 0;
  };
  /// The slices inside the triangle, those along its edges, and whether it is back to back with another.
  struct Found {
    std::vector<Slice> inside;
    std::vector<EdgeSlice> along;
    bool isTouching = false;
  };
  Found slicesOf(std::uint32_t number) const {
    const auto& [a, b, c] = owners_[number].triangle->position;
    std::vector<std::uint32_t> others;
    tree_.appendNear(glm::min(glm::min(a, b), c) - tolerance_, glm::max(glm::max(a, b), c) + tolerance_, others,
                     owners_[number].except);
    const WeightedTriangle plane(*owners_[number].triangle, lift_, tolerance_);
    Found found;
    for (const std::uint32_t other : others) {
      if (other == number || areOfOnePart(number, other)) continue;
      const Triangle slicing = triangleAt(other);
      found.isTouching = found.isTouching || plane.isBackToBackWith(slicing);
      const std::optional<Slice> slice = sliceOf(slicing, plane);
      // Edges moved outwards meet far beyond an acute corner; a slice that only passes there is outside the triangle.
      if (!slice || !plane.clipped(*slice, roundingShare * tolerance_)) continue;
      const Slice part = *plane.clipped(*slice, tolerance_);
      if (plane.clipped(part, -tolerance_))
        found.inside.push_back(part);
      else
        found.along.push_back({part, other});
    }
    // Sorted by position, so that the order of surfaces does not matter.
    std::sort(found.inside.begin(), found.inside.end(), isBefore);
    std::sort(found.along.begin(), found.along.end(),
              [](const EdgeSlice& one, const EdgeSlice& two) { return isBefore(one.slice, two.slice); });
    return found;
  }

  /// The slices along inner edges of the surface, those that the triangle shares with a neighbour. Slices by that
  /// neighbour are left out: where a surface folds, its triangles slice each other along the edge. `first` is the
  /// number of the surface's first triangle in the scene.
  std::vector<Slice> alongInnerEdges(const Triangle& triangle, const std::array<std::uint32_t, 3>& neighbours,
                                     std::size_t first, const std::vector<EdgeSlice>& along) const {
    const WeightedTriangle plane(triangle, 0, tolerance_);
    std::vector<Slice> inner;
    for (const EdgeSlice& edge : along) {
      const std::optional<std::size_t> opposite = plane.edgeAlong(edge.slice);
      if (!opposite || neighbours[*opposite] == noNeighbour || first + neighbours[*opposite] == edge.other) continue;
      inner.push_back(edge.slice);
    }
    return inner;
  }

 private:
  struct Owner {
    const Triangle* triangle;
    const Surface* surface;
    std::uint32_t except;  ///< the number of the surface if it cannot slice itself
  };

  /// A triangle in space.
  Triangle triangleAt(std::uint32_t number) const {
    return placed(*owners_[number % owners_.size()].triangle, scene_.instances[number / owners_.size()]);
  }

  /// Triangles in one plane do not slice each other, and those of a curved part are left out.
  static bool maySliceItself(const Surface& surface) {
    const glm::dvec3 first = normal(surface.triangles.front());
    return !surface.curvedPart &&
           !std::all_of(surface.triangles.begin(), surface.triangles.end(),
                        [&](const Triangle& triangle) { return areParallel(first, normal(triangle)); });
  }

  /// Where a curved part is hollow, its triangles slice each other near corners, but the part does not stand on itself.
  bool areOfOnePart(std::uint32_t number, std::uint32_t other) const {
    if (other >= owners_.size()) return false;
    const Surface &one = *owners_[number].surface, &two = *owners_[other].surface;
    return one.curvedPart && one.curvedPart == two.curvedPart && one.family == two.family;
  }

  const Scene& scene_;
  double lift_, tolerance_;
  std::vector<Owner> owners_;  ///< of each triangle of the first instance
  const RayTree& tree_;
};

}  // namespace

SceneSlices triangleSlices(const Scene& scene, const RayTree& tree) {
  const Slicer slicer(scene, tree);
  std::vector<Slicer::Found> found(triangleCount(scene));
  raster::parallelFor(found.size(),
                      [&](std::size_t number) { found[number] = slicer.slicesOf(static_cast<std::uint32_t>(number)); });
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const Surface& surface : scene.surfaces) first.push_back(std::exchange(count, count + surface.triangles.size()));
  const auto foundOf = [&](std::size_t s) {
    return std::span(found).subspan(first[s], scene.surfaces[s].triangles.size());
  };
  raster::parallelFor(first.size(), [&](std::size_t s) {
    const std::span<Slicer::Found> own = foundOf(s);
    // A single triangle has no inner edge.
    if (own.size() == 1 || std::all_of(own.begin(), own.end(), [](const auto& of) { return of.along.empty(); })) return;
    const auto beside = neighbours(scene.surfaces[s]);
    for (std::uint32_t t = 0; t < own.size(); ++t) {
      const auto inner = slicer.alongInnerEdges(scene.surfaces[s].triangles[t], beside[t], first[s], own[t].along);
      own[t].inside.insert(own[t].inside.end(), inner.begin(), inner.end());
    }
  });
  SceneSlices slices;
  for (std::size_t s = 0; s < first.size(); ++s) {
    const auto own = foundOf(s);
    slices.isTouching.push_back(std::any_of(own.begin(), own.end(), [](const auto& of) { return of.isTouching; }));
    for (Slicer::Found& of : own) slices.ofTriangle.push_back(std::move(of.inside));
  }
  return slices;
}

}  // namespace hemitex::radiosity
