#include "reference/rows/free_shafts.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>

#include "radiosity/geometry/convex_part.h"
#include "radiosity/geometry/triangulation.h"

namespace hemitex::reference {
namespace {

using radiosity::SpaceBox;

/// In extents of the scene: contacts up to this depth hide nothing.
constexpr double slack = 1e-10;

using Corners = std::span<const glm::dvec3>;

glm::dvec3 normalOf(Corners polygon) { return glm::normalize(radiosity::newellNormal(polygon)); }

glm::dvec3 middleOf(Corners polygon) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

/// The range of places of points along an axis.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void include(Corners points, const glm::dvec3& axis) {
    for (const glm::dvec3& point : points) {
      const double place = glm::dot(axis, point);
      low = std::min(low, place);
      high = std::max(high, place);
    }
  }
};

bool areApart(const Range& a, const Range& b) { return a.low >= b.high - slack || b.low >= a.high - slack; }

SpaceBox boxOf(Corners points) {
  SpaceBox box{points[0], points[0]};
  for (const glm::dvec3& point : points) box = {glm::min(box.low, point), glm::max(box.high, point)};
  return box;
}

/// Whether polygons are apart along a direction.
bool areApartAlong(const glm::dvec3& direction, std::initializer_list<Corners> some, Corners other) {
  const double length = glm::length(direction);
  if (length < 1e-9) return false;
  Range range, others;
  for (const Corners points : some) range.include(points, direction / length);
  others.include(other, direction / length);
  return areApart(range, others);
}

/// Calls test(edge) for the edges of a polygon until it is true.
template <typename Test>
bool anyEdge(Corners polygon, const Test& test) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (test(polygon[(k + 1) % polygon.size()] - polygon[k])) return true;
  return false;
}

/// Whether a polygon lies in the plane of another and faces the same way.
bool isInPlane(Corners polygon, const glm::dvec3& normal, Corners other, const glm::dvec3& otherNormal) {
  return glm::dot(normal, otherNormal) > 1 - 1e-9 && std::all_of(other.begin(), other.end(), [&](const auto& corner) {
           return std::abs(glm::dot(normal, corner - polygon[0])) <= slack;
         });
}

/// Whether polygons in one plane have no common area.
bool areBeside(Corners a, Corners b, const glm::dvec3& normal) {
  const auto separates = [&](const glm::dvec3& edge) { return areApartAlong(glm::cross(edge, normal), {a}, b); };
  return anyEdge(a, separates) || anyEdge(b, separates);
}

/// Two polygons, each in front of the other, and what is between them.
struct Shaft {
  Corners from, to;
  glm::dvec3 fromNormal, toNormal;

  /// Whether another polygon certainly hides nothing: a plane separates it from the shaft, or it is beside an end of
  /// the shaft in the plane of this end.
  bool isBeside(Corners other, const glm::dvec3& normal) const {
    if (isInPlane(from, fromNormal, other, normal)) return areBeside(from, other, normal);
    if (isInPlane(to, toNormal, other, normal)) return areBeside(to, other, normal);
    const auto isAlong = [&](const glm::dvec3& direction) { return areApartAlong(direction, {from, to}, other); };
    if (isAlong(normal) || isAlong(fromNormal) || isAlong(toNormal)) return true;
    const glm::dvec3 a = middleOf(from), b = middleOf(to), c = middleOf(other);
    const auto hasPlane = [&](Corners edges, const glm::dvec3& line) {
      return anyEdge(edges, [&](const glm::dvec3& edge) { return isAlong(glm::cross(edge, line)); });
    };
    return hasPlane(other, b - a) || hasPlane(from, c - b) || hasPlane(to, c - a) || hasPlane(from, b - a) ||
           hasPlane(to, b - a);
  }
};

}  // namespace

FreeShafts::FreeShafts(std::vector<ConvexPolygons> facets) : facets_(std::move(facets)), boxes_({}) {
  std::vector<SpaceBox> boxes;
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    first_.push_back(static_cast<std::uint32_t>(parts_.size()));
    for (const std::vector<glm::dvec3>& polygon : facets_[f]) {
      parts_.push_back({f, polygon, normalOf(polygon)});
      boxes.push_back(boxOf(polygon));
    }
  }
  first_.push_back(static_cast<std::uint32_t>(parts_.size()));
  boxes_ = radiosity::NearestBoxes(boxes);
}

bool FreeShafts::isFree(std::uint32_t from, std::uint32_t to) const {
  for (std::uint32_t a = first_[from]; a < first_[from + std::size_t{1}]; ++a)
    for (std::uint32_t b = first_[to]; b < first_[to + std::size_t{1}]; ++b)
      if (!isFree(parts_[a], parts_[b])) return false;
  return true;
}

bool FreeShafts::maySeeBack(std::uint32_t from, std::uint32_t to) const {
  const auto reaches = [](Corners corners, const glm::dvec3& point, const glm::dvec3& normal) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](const glm::dvec3& corner) { return glm::dot(normal, corner - point) > slack; });
  };
  for (std::uint32_t a = first_[from]; a < first_[from + std::size_t{1}]; ++a)
    for (std::uint32_t b = first_[to]; b < first_[to + std::size_t{1}]; ++b)
      if (reaches(parts_[b].corners, parts_[a].corners[0], parts_[a].normal) &&
          reaches(parts_[a].corners, parts_[b].corners[0], -parts_[b].normal))
        return true;
  return false;
}

bool FreeShafts::isFree(const Part& from, const Part& to) const {
  const radiosity::ConvexPart a = radiosity::inFrontOf(from.corners, to.corners[0], to.normal),
                              b = radiosity::inFrontOf(to.corners, from.corners[0], from.normal);
  if (a.count < 3 || b.count < 3) return true;
  const Shaft shaft{a.span(), b.span(), from.normal, to.normal};
  const SpaceBox boxA = boxOf(shaft.from), boxB = boxOf(shaft.to);
  const SpaceBox box{glm::min(boxA.low, boxB.low) - slack, glm::max(boxA.high, boxB.high) + slack};
  const auto meets = [&](const SpaceBox& other) {
    return glm::all(glm::lessThanEqual(other.low, box.high)) && glm::all(glm::lessThanEqual(box.low, other.high));
  };
  const auto isBlocker = [&](std::uint32_t number) {
    const Part& other = parts_[number];
    return &other != &from && &other != &to && meets(boxOf(other.corners)) &&
           !shaft.isBeside(other.corners, other.normal);
  };
  return !boxes_.any(meets, isBlocker);
}

}  // namespace hemitex::reference
