#include "radiosity/geometry/contact_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "raster/base/cross.h"

namespace hemitex::radiosity {
namespace {

using raster::cross;
using Polygon = std::vector<glm::dvec2>;  ///< convex, counter-clockwise, in weights

/// Faces are parallel if the cosine of the angle between them is at least this.
constexpr double minCosine = 0.999;
/// Cuts take time in the square of the number of others.
constexpr std::size_t maxOthers = 10000;
/// Heights of a triangle that are larger than the distance of contact by this are far above it.
constexpr double minHeights = 64;

glm::dvec3 unitNormal(const TrianglePositions& triangle) {
  return glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
}

/// The smallest height of a triangle.
double heightOf(const TrianglePositions& t) {
  const double longest = std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
  return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / longest;
}

/// The plane of a triangle: weights, and places in units of length.
class Plane {
 public:
  explicit Plane(const TrianglePositions& triangle) : corner_(triangle[0]), normal_(unitNormal(triangle)) {
    const glm::dvec3 along1 = triangle[1] - triangle[0], along2 = triangle[2] - triangle[0];
    x_ = glm::normalize(along1);
    y_ = glm::cross(normal_, x_);
    toPlane_ = {{glm::dot(along1, x_), 0}, {glm::dot(along2, x_), glm::dot(along2, y_)}};
  }

  const glm::dvec3& normal() const { return normal_; }
  glm::dvec2 place(const glm::dvec2& weights) const { return toPlane_ * weights; }
  glm::dvec2 weightsOf(const glm::dvec3& position) const {
    const glm::dvec3 offset = position - corner_;
    const double second = glm::dot(offset, y_) / toPlane_[1].y;
    return {(glm::dot(offset, x_) - second * toPlane_[1].x) / toPlane_[0].x, second};
  }
  double heightOf(const glm::dvec3& position) const { return glm::dot(position - corner_, normal_); }

 private:
  glm::dvec3 corner_, normal_, x_, y_;
  glm::dmat2 toPlane_;
};

/// The parts of a polygon on the left and on the right of a line from a to b. Corners within the tolerance lie on it.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane, const glm::dvec2& a, const glm::dvec2& b,
                                  double tolerance) {
  const glm::dvec2 start = plane.place(a), along = glm::normalize(plane.place(b) - start);
  std::vector<double> distances;
  for (const glm::dvec2& corner : polygon) {
    const double distance = cross(along, plane.place(corner) - start);
    distances.push_back(std::abs(distance) <= tolerance ? 0 : distance);
  }
  const auto [lowest, highest] = std::minmax_element(distances.begin(), distances.end());
  if (*lowest >= 0) return {polygon, {}};
  if (*highest <= 0) return {{}, polygon};
  std::pair<Polygon, Polygon> parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (distances[i] >= 0) parts.first.push_back(polygon[i]);
    if (distances[i] <= 0) parts.second.push_back(polygon[i]);
    if (distances[i] * distances[next] >= 0) continue;
    const double share = distances[i] / (distances[i] - distances[next]);
    const glm::dvec2 crossing = polygon[i] + share * (polygon[next] - polygon[i]);
    parts.first.push_back(crossing);
    parts.second.push_back(crossing);
  }
  return parts;
}

/// The part of a polygon inside another triangle; without corners if there is none. Otherwise calls outside(part) for
/// the rest.
template <typename Visit>
Polygon inside(const Polygon& polygon, const Plane& plane, const FaceInPlace& other, const Visit& outside) {
  Polygon left = polygon;
  std::vector<Polygon> rest;
  for (std::size_t k = 0; k < 3 && !left.empty(); ++k) {
    auto [within, beyond] = split(left, plane, other.corners[k], other.corners[(k + 1) % 3], other.tolerance);
    if (!beyond.empty()) rest.push_back(std::move(beyond));
    left = std::move(within);
  }
  if (!left.empty())
    for (Polygon& part : rest) outside(std::move(part));
  return left;
}

/// Twice the area of a polygon in weights, which is its share of the triangle.
double doubledArea(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return sum;
}

/// Whether the boxes around a polygon and a triangle meet, in weights.
bool mayMeet(const Polygon& polygon, const FaceInPlace& other) {
  glm::dvec2 low = polygon[0], high = low;
  for (const glm::dvec2& corner : polygon) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  return glm::all(glm::lessThanEqual(low, other.high)) && glm::all(glm::greaterThanEqual(high, other.low));
}

FaceInPlace otherOf(const TrianglePositions& triangle, std::uint32_t number, const Plane& plane, double tolerance) {
  const std::array corners{plane.weightsOf(triangle[0]), plane.weightsOf(triangle[1]), plane.weightsOf(triangle[2])};
  FaceInPlace other{number,
                    corners,
                    glm::dot(unitNormal(triangle), plane.normal()) < 0,
                    4 * tolerance,
                    glm::min(glm::min(corners[0], corners[1]), corners[2]),
                    glm::max(glm::max(corners[0], corners[1]), corners[2]),
                    0};
  if (other.isOpposite) std::swap(other.corners[1], other.corners[2]);
  return other;
}

const Polygon unitTriangle{{0, 0}, {1, 0}, {0, 1}};

/// Whether a triangle lies beyond an edge of the one whose weights its corners have, as most neighbours do.
bool isBeyond(const std::array<glm::dvec2, 3>& corners) {
  constexpr double rounding = 1e-9;
  const auto all = [&](const auto& isOutside) { return std::all_of(corners.begin(), corners.end(), isOutside); };
  return all([](const glm::dvec2& w) { return w.x <= rounding; }) ||
         all([](const glm::dvec2& w) { return w.y <= rounding; }) ||
         all([](const glm::dvec2& w) { return w.x + w.y >= 1 - rounding; });
}

/// Another triangle, if it has a place in common with a triangle, whose plane and height are given.
std::optional<FaceInPlace> inOnePlace(const TrianglePositions& triangle, const NumberedTriangle& candidate,
                                      const Plane& plane, double height, double largestTolerance) {
  const TrianglePositions& corners = candidate.positions;
  const auto [lowest, highest] =
      std::minmax({plane.heightOf(corners[0]), plane.heightOf(corners[1]), plane.heightOf(corners[2])});
  if (lowest > largestTolerance || highest < -largestTolerance) return std::nullopt;
  const glm::dvec3 normal = unitNormal(corners);
  if (std::abs(glm::dot(normal, plane.normal())) < minCosine) return std::nullopt;
  const double tolerance = std::min(largestTolerance, std::min(height, heightOf(corners)) / minHeights);
  if (lowest > tolerance || highest < -tolerance) return std::nullopt;
  FaceInPlace other = otherOf(corners, candidate.number, plane, tolerance);
  if (isBeyond(other.corners)) return std::nullopt;
  const Polygon common = inside(unitTriangle, plane, other, [](const Polygon&) {});
  const bool isNear = std::all_of(common.begin(), common.end(), [&](const glm::dvec2& weights) {
    const auto& [a, b, c] = triangle;
    return std::abs(glm::dot(a + weights.x * (b - a) + weights.y * (c - a) - corners[0], normal)) <= tolerance;
  });
  if (common.empty() || !isNear) return std::nullopt;
  other.share = doubledArea(common);
  return other;
}

/// Whether the solid of a triangle stands on another one in the same place, instead of being a skin.
bool standsOn(const ContactRules& rules, std::uint32_t triangle, std::uint32_t other) {
  const Shells& shells = rules.shells;
  const std::uint32_t own = shells.ofTriangle[triangle], room = shells.ofTriangle[other];
  if (shells.kinds[own] != ShellKind::Solid || rules.isSkin[own]) return false;
  const bool isSkinOfRoom = shells.isClosed[own] && shells.isClosed[room] && shells.kinds[room] == ShellKind::Room &&
                            shells.volumes[own] >= -(1 - shellVolumeRounding) * shells.volumes[room];
  return !isSkinOfRoom;
}

/// Whether two triangles belong to closed solids, which are joined where they touch.
bool areJoined(const ContactRules& rules, std::uint32_t triangle, std::uint32_t other) {
  const Shells& shells = rules.shells;
  const auto isOfSolid = [&](std::uint32_t t) {
    const std::uint32_t shell = shells.ofTriangle[t];
    return shells.kinds[shell] == ShellKind::Solid && shells.isClosed[shell] && !rules.isSkin[shell] &&
           !shells.isTurnedOver[t];
  };
  const bool isIndoors = !rules.isIndoors.empty() && rules.isIndoors[triangle] != 0;
  return !isIndoors && isOfSolid(triangle) && isOfSolid(other);
}

/// A part of a triangle while others cut it.
struct CutPart {
  Polygon polygon;
  bool isBacked = false;  ///< by a face that it does not stand on
  bool isJoined = false;
  bool isOpposed = false;                   ///< whether any face looks the other way
  std::vector<std::uint32_t> sameWay = {};  ///< those that look the same way, ascending
};

/// Cuts the parts of triangle `number` by another one.
std::vector<CutPart> cutBy(const FaceInPlace& other, std::uint32_t number, const ContactRules& rules,
                           std::vector<CutPart> parts, const Plane& plane) {
  const bool isJoined = other.isOpposite && areJoined(rules, number, other.number);
  const bool isBacking = other.isOpposite && !standsOn(rules, number, other.number);
  std::vector<CutPart> result;
  for (CutPart& part : parts) {
    CutPart within = part;
    within.polygon.clear();
    if (mayMeet(part.polygon, other))
      within.polygon = inside(part.polygon, plane, other, [&](Polygon polygon) {
        result.push_back(part);
        result.back().polygon = std::move(polygon);
      });
    if (within.polygon.empty()) {
      result.push_back(std::move(part));
      continue;
    }
    within.isOpposed = within.isOpposed || other.isOpposite;
    within.isBacked = within.isBacked || isBacking;
    within.isJoined = within.isJoined || isJoined;
    if (!other.isOpposite) within.sameWay.push_back(other.number);
    result.push_back(std::move(within));
  }
  return result;
}

/// Whether a part of a triangle reaches one of its edges.
bool reachesBorder(const Polygon& polygon) {
  constexpr double rounding = 1e-9;
  return std::any_of(polygon.begin(), polygon.end(), [](const glm::dvec2& weights) {
    return std::min({weights.x, weights.y, 1 - weights.x - weights.y}) <= rounding;
  });
}

/// The contact of a part of triangle `number`. The front of a solid that stands on something covers nothing.
Contact contactOf(const CutPart& part, std::uint32_t number, const ContactRules& rules) {
  const auto rank = [&](std::uint32_t n) {
    return std::pair(!(part.isOpposed && rules.shells.kindOf(n) == ShellKind::Solid), rules.ranks[n]);
  };
  std::uint32_t last = number;
  for (const std::uint32_t n : part.sameWay)
    if (rank(n) > rank(last)) last = n;
  Contact contact{.isBacked = part.isBacked, .isJoined = part.isJoined};
  if (last != number) contact.coveredBy = last;
  return contact;
}

}  // namespace

std::vector<FaceInPlace> facesInPlace(const TrianglePositions& triangle, std::span<const NumberedTriangle> near,
                                      double tolerance) {
  const Plane plane(triangle);
  const double height = heightOf(triangle);
  std::vector<FaceInPlace> others;
  for (const NumberedTriangle& candidate : near)
    if (auto other = inOnePlace(triangle, candidate, plane, height, tolerance)) others.push_back(*other);
  std::sort(others.begin(), others.end(),
            [](const FaceInPlace& a, const FaceInPlace& b) { return a.number < b.number; });
  return others;
}

std::vector<ContactPart> contactParts(const TrianglePositions& triangle, std::uint32_t number,
                                      std::vector<FaceInPlace> others, const ContactRules& rules) {
  // What stands on this triangle backs nothing.
  std::erase_if(others, [&](const FaceInPlace& other) {
    return other.isOpposite && standsOn(rules, other.number, number) && !areJoined(rules, number, other.number);
  });
  const bool matters = std::any_of(others.begin(), others.end(), [&](const FaceInPlace& other) {
    return !other.isOpposite || !standsOn(rules, number, other.number) || areJoined(rules, number, other.number);
  });
  if (others.size() > maxOthers || !matters) return {};
  const Plane plane(triangle);
  std::vector<CutPart> parts{{unitTriangle}};
  for (const FaceInPlace& other : others) parts = cutBy(other, number, rules, std::move(parts), plane);
  const bool isWhole = std::all_of(parts.begin(), parts.end(), [](const CutPart& part) { return part.isJoined; });
  std::vector<ContactPart> result;
  for (CutPart& part : parts) {
    // Exposure finds the others without a cut.
    part.isJoined = part.isJoined && !isWhole && reachesBorder(part.polygon);
    const Contact contact = contactOf(part, number, rules);
    result.push_back({std::move(part.polygon), contact});
  }
  const Contact& first = result.front().contact;
  const bool isOne = std::all_of(result.begin(), result.end(), [&](const ContactPart& part) {
    return part.contact.isBacked == first.isBacked && part.contact.isJoined == first.isJoined &&
           part.contact.coveredBy.has_value() == first.coveredBy.has_value();
  });
  if (isOne && first == Contact{}) return {};
  if (isOne) return {{unitTriangle, first}};
  return result;
}

}  // namespace hemitex::radiosity
