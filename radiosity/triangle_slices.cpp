#include "radiosity/triangle_slices.h"

#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "radiosity/shooting_view.h"
#include "raster/parallel.h"

namespace hemitex::radiosity {
namespace {

namespace index = boost::geometry::index;
using BoostPoint = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using BoostBox = boost::geometry::model::box<BoostPoint>;
using BoxedTriangle = std::pair<BoostBox, std::uint32_t>;  ///< with its number in the scene

BoostBox boxAround(const Triangle& triangle, double margin) {
  const auto& [a, b, c] = triangle.position;
  const glm::dvec3 low = glm::min(glm::min(a, b), c) - margin, high = glm::max(glm::max(a, b), c) + margin;
  return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

/// A triangle with what its barycentric weights are found with.
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
    // Of the corners over the opposite edges.
    heights_ = {doubledArea / glm::length(along2_ - along1_), doubledArea / glm::length(along2_),
                doubledArea / glm::length(along1_)};
  }

  /// Over the plane of the slices.
  double heightOf(const glm::dvec3& point) const {
    return glm::dot(point - corner_, normal_) / glm::length(normal_) - lift_;
  }

  glm::dvec2 weightsOf(const glm::dvec3& point) const { return weightsOfStep(point - corner_); }

  /// How far the weights change from where a triangle crosses the plane of the slices to where its plane meets that of
  /// this one; not at all where both are parallel, to within a lift in some hundred.
  glm::dvec2 stepToSurface(const Triangle& triangle) const {
    constexpr double leastSine = 1 / 256.0;
    const glm::dvec3 n = normal_ / glm::length(normal_), m = normal(triangle);
    const glm::dvec3 down =
        glm::dot(m, n) * m - n;  // along the triangle, as long as the sine of the angle between both
    const double squaredSine = glm::dot(down, down);
    if (squaredSine < leastSine * leastSine) return glm::dvec2(0);
    return weightsOfStep(lift_ / squaredSine * down);
  }

  double lengthOf(const Slice& slice) const {
    const glm::dvec2 step = slice.to - slice.from;
    return glm::length(step.x * along1_ + step.y * along2_);
  }

  /// The part of a slice inside the triangle, whose edges are first moved outwards by `margin`, a length; nothing where
  /// less than the tolerance is left.
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
    const Slice part{slice.from + first * step, slice.from + last * step};
    if (first >= last || lengthOf(part) <= tolerance_) return std::nullopt;
    return part;
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

/// Where a triangle crosses the plane of another's slices.
std::optional<Slice> sliceOf(const Triangle& triangle, const WeightedTriangle& plane) {
  std::array<double, 3> height;
  for (std::size_t k = 0; k < 3; ++k) height[k] = plane.heightOf(triangle.position[k]);
  std::array<glm::dvec2, 2> ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3 && count < 2; ++k) {
    const std::size_t next = (k + 1) % 3;
    if ((height[k] >= 0) == (height[next] >= 0)) continue;
    const double t = height[k] / (height[k] - height[next]);
    // Not of a point between: where a scene lies does not matter then.
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

using Edge = std::pair<std::array<double, 3>, std::array<double, 3>>;

Edge edgeOf(const Triangle& triangle, std::size_t opposite) {
  const glm::dvec3 &a = triangle.position[(opposite + 1) % 3], &b = triangle.position[(opposite + 2) % 3];
  const std::array<double, 3> first{a.x, a.y, a.z}, second{b.x, b.y, b.z};
  return first < second ? Edge{first, second} : Edge{second, first};
}

/// The triangles of a surface that have each edge.
std::map<Edge, std::vector<std::uint32_t>> trianglesByEdge(const Surface& surface) {
  std::map<Edge, std::vector<std::uint32_t>> triangles;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) triangles[edgeOf(surface.triangles[t], k)].push_back(t);
  return triangles;
}

/// Slices of a triangle by what else the scene has.
class Slicer {
 public:
  explicit Slicer(const Scene& scene) : lift_(eyeLift * scene.extent), tolerance_(eyeMove * scene.extent) {
    std::vector<BoxedTriangle> boxes;
    for (const Surface& surface : scene.surfaces)
      for (const Triangle& triangle : surface.triangles) {
        boxes.emplace_back(boxAround(triangle, 0), static_cast<std::uint32_t>(triangles_.size()));
        triangles_.push_back(&triangle);
      }
    tree_ = Tree(boxes);
  }

  /// Those inside the triangle, and those along its edges.
  struct Found {
    std::vector<Slice> inside, along;
  };
  Found slicesOf(std::uint32_t number) const {
    std::vector<BoxedTriangle> near;
    tree_.query(index::intersects(boxAround(*triangles_[number], tolerance_)), std::back_inserter(near));
    const WeightedTriangle plane(*triangles_[number], lift_, tolerance_);
    Found found;
    for (const auto& [box, other] : near) {
      if (other == number) continue;
      const std::optional<Slice> slice = sliceOf(*triangles_[other], plane);
      const std::optional<Slice> part = slice ? plane.clipped(*slice, tolerance_) : std::nullopt;
      if (part) (plane.clipped(*part, -tolerance_) ? found.inside : found.along).push_back(*part);
    }
    // By where they are: the order of surfaces does not matter.
    std::sort(found.inside.begin(), found.inside.end(), isBefore);
    std::sort(found.along.begin(), found.along.end(), isBefore);
    return found;
  }

  /// Of the slices along the edges of a triangle, those along edges that it shares with a triangle in its plane.
  std::vector<Slice> alongInnerEdges(const Surface& surface, std::uint32_t triangle,
                                     const std::map<Edge, std::vector<std::uint32_t>>& byEdge,
                                     const std::vector<Slice>& along) const {
    const WeightedTriangle plane(surface.triangles[triangle], 0, tolerance_);
    const auto liesInPlane = [&](std::uint32_t other) {
      const auto& corners = surface.triangles[other].position;
      return other != triangle && std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& corner) {
               return std::abs(plane.heightOf(corner)) <= lift_;
             });
    };
    std::vector<Slice> inner;
    for (const Slice& slice : along) {
      const std::optional<std::size_t> opposite = plane.edgeAlong(slice);
      if (!opposite) continue;
      const std::vector<std::uint32_t>& sharing = byEdge.at(edgeOf(surface.triangles[triangle], *opposite));
      if (std::any_of(sharing.begin(), sharing.end(), liesInPlane)) inner.push_back(slice);
    }
    return inner;
  }

 private:
  using Tree = index::rtree<BoxedTriangle, index::quadratic<16>>;

  double lift_, tolerance_;
  std::vector<const Triangle*> triangles_;
  Tree tree_;
};

}  // namespace

std::vector<std::vector<Slice>> triangleSlices(const Scene& scene) {
  const Slicer slicer(scene);
  std::vector<std::vector<Slice>> slices(triangleCount(scene));
  std::vector<std::vector<Slice>> along(slices.size());
  raster::parallelFor(slices.size(), [&](std::size_t number) {
    auto [inside, beside] = slicer.slicesOf(static_cast<std::uint32_t>(number));
    slices[number] = std::move(inside);
    along[number] = std::move(beside);
  });
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const Surface& surface : scene.surfaces) first.push_back(std::exchange(count, count + surface.triangles.size()));
  raster::parallelFor(scene.surfaces.size(), [&](std::size_t s) {
    const Surface& surface = scene.surfaces[s];
    // A triangle alone has no inner edge.
    if (surface.triangles.size() == 1) return;
    const auto hasSlices = [](const std::vector<Slice>& some) { return !some.empty(); };
    const auto begin = along.begin() + static_cast<std::ptrdiff_t>(first[s]);
    if (std::none_of(begin, begin + static_cast<std::ptrdiff_t>(surface.triangles.size()), hasSlices)) return;
    const auto byEdge = trianglesByEdge(surface);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      const std::vector<Slice> inner = slicer.alongInnerEdges(surface, t, byEdge, along[first[s] + t]);
      slices[first[s] + t].insert(slices[first[s] + t].end(), inner.begin(), inner.end());
    }
  });
  return slices;
}

}  // namespace hemitex::radiosity
