#include "radiosity/geometry/triangulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "radiosity/geometry/point_tree.h"

namespace hemitex::radiosity {
namespace {

double largestCoordinate(std::span<const glm::dvec3> points) {
  double largest = 0;
  for (const glm::dvec3& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return largest;
}

/// The largest height that rounding alone can cause.
double heightNoise(std::span<const glm::dvec3> points) {
  return 4 * std::numeric_limits<double>::epsilon() * largestCoordinate(points);
}

/// A polygon in the plane, counter-clockwise.
struct Outline {
  std::vector<glm::dvec2> points;
  double noise = 0;
};

/// 1 for a left turn at `b`, -1 for a right turn, 0 if the three points are collinear.
int turn(const Outline& outline, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const glm::dvec2 ab = outline.points[b] - outline.points[a];
  const glm::dvec2 ac = outline.points[c] - outline.points[a];
  const glm::dvec2 bc = outline.points[c] - outline.points[b];
  const double doubledArea = ab.x * ac.y - ab.y * ac.x;
  const double longest = std::sqrt(std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)}));
  if (std::fabs(doubledArea) <= outline.noise * longest) return 0;
  return doubledArea > 0 ? 1 : -1;
}

/// The polygon projected along `normal`, which is not zero.
Outline projected(std::span<const glm::dvec3> polygon, const glm::dvec3& normal) {
  const glm::dvec3 n = normal / glm::length(normal);
  const glm::dvec3 size = glm::abs(n);
  const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                          : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                               : glm::dvec3(0, 0, 1);
  const glm::dvec3 cross = glm::cross(n, axis);
  const glm::dvec3 u = cross / glm::length(cross);
  const glm::dvec3 v = glm::cross(n, u);
  Outline outline{{}, heightNoise(polygon)};
  for (const glm::dvec3& p : polygon)
    outline.points.emplace_back(glm::dot(u, p - polygon[0]), glm::dot(v, p - polygon[0]));
  return outline;
}

/// It has no right turn and winds around once, so that no triangle of its fan turns right.
bool isConvex(const Outline& outline) {
  const auto n = static_cast<std::uint32_t>(outline.points.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    if (turn(outline, i, next, (i + 2) % n) < 0 || turn(outline, 0, i, next) < 0) return false;
  }
  return true;
}

std::vector<std::array<std::uint32_t, 3>> fan(std::uint32_t corners) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

/// Cuts off ears. The next ear is the first one from the corner behind the last. Where there is none, the first
/// collinear corner is cut off, or, which happens only for a polygon that crosses itself, the next corner.
///
/// A corner is tested again only if that can change the answer: when a neighbour was cut off, or the corner that was
/// found in its triangle.
class EarClipper {
 public:
  explicit EarClipper(const Outline& outline)
      : outline_(outline),
        before_(outline.points.size()),
        after_(outline.points.size()),
        isCut_(outline.points.size()),
        blocked_(outline.points.size()),
        rest_(outline.points),
        longest_(2 * diagonal(outline)) {
    const auto n = static_cast<std::uint32_t>(outline.points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      before_[i] = (i + n - 1) % n;
      after_[i] = (i + 1) % n;
    }
    for (std::uint32_t i = 0; i < n; ++i) noteChange(i);
  }

  Triangulation clip() {
    Triangulation result;
    std::uint32_t at = 0;
    for (std::size_t count = outline_.points.size(); count > 3; --count) {
      std::optional<std::uint32_t> corner = nextEar(at);
      if (!corner) corner = nextStraight(at);
      result.crossing = result.crossing || !corner;
      at = cutOff(corner.value_or(at), result);
    }
    const std::array<std::uint32_t, 3> last = std::array{at, after_[at], before_[at]};
    const std::uint32_t first = *std::min_element(last.begin(), last.end());
    result.triangles.push_back({first, after_[first], before_[first]});
    result.crossing = result.crossing || turn(outline_, first, after_[first], before_[first]) < 0;
    return result;
  }

 private:
  static double diagonal(const Outline& outline) {
    glm::dvec2 low = outline.points[0], high = low;
    for (const glm::dvec2& p : outline.points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    return glm::length(high - low);
  }

  /// The first corner of a set from `at` on, around the ring.
  static std::optional<std::uint32_t> firstFrom(const std::set<std::uint32_t>& corners, std::uint32_t at) {
    if (corners.empty()) return std::nullopt;
    const auto found = corners.lower_bound(at);
    return found == corners.end() ? *corners.begin() : *found;
  }

  std::optional<std::uint32_t> nextEar(std::uint32_t at) {
    for (;;) {
      const std::optional<std::uint32_t> corner = firstFrom(open_, at);
      if (!corner || isEar(*corner)) return corner;
      open_.erase(*corner);
    }
  }

  std::optional<std::uint32_t> nextStraight(std::uint32_t at) const { return firstFrom(straight_, at); }

  bool isEar(std::uint32_t corner) {
    const std::uint32_t a = before_[corner], b = corner, c = after_[corner];
    if (turn(outline_, a, b, c) <= 0) return false;
    const std::optional<std::uint32_t> inside = cornerWithin(a, b, c);
    if (inside) blocked_[*inside].push_back(corner);
    return !inside;
  }

  /// A remaining corner in a triangle or on its border, other than at its corners.
  std::optional<std::uint32_t> cornerWithin(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const std::vector<glm::dvec2>& points = outline_.points;
    // Rounding is monotonic, so that no point of the box has a larger area than this corner of the box.
    const auto reaches = [&](std::uint32_t from, std::uint32_t to, const glm::dvec2& low, const glm::dvec2& high) {
      const glm::dvec2 edge = points[to] - points[from];
      const double x = (edge.y > 0 ? low.x : high.x) - points[from].x;
      const double y = (edge.x > 0 ? high.y : low.y) - points[from].y;
      return edge.x * y - edge.y * x >= -outline_.noise * longest_;
    };
    return rest_.find(
        [&](const glm::dvec2& low, const glm::dvec2& high) {
          return reaches(a, b, low, high) && reaches(b, c, low, high) && reaches(c, a, low, high);
        },
        [&](std::uint32_t q) {
          const glm::dvec2& p = points[q];
          if (p == points[a] || p == points[b] || p == points[c]) return false;
          return turn(outline_, a, b, q) >= 0 && turn(outline_, b, c, q) >= 0 && turn(outline_, c, a, q) >= 0;
        });
  }

  /// Removes a corner with its triangle, and returns the next one.
  std::uint32_t cutOff(std::uint32_t corner, Triangulation& result) {
    const std::uint32_t previous = before_[corner], next = after_[corner];
    result.triangles.push_back({previous, corner, next});
    after_[previous] = next;
    before_[next] = previous;
    isCut_[corner] = true;
    rest_.remove(corner);
    open_.erase(corner);
    straight_.erase(corner);
    for (const std::uint32_t other : blocked_[corner])
      if (!isCut_[other]) open_.insert(other);
    noteChange(previous);
    noteChange(next);
    return next;
  }

  /// The neighbours of a corner are new.
  void noteChange(std::uint32_t corner) {
    open_.insert(open_.end(), corner);
    if (turn(outline_, before_[corner], corner, after_[corner]) == 0)
      straight_.insert(corner);
    else
      straight_.erase(corner);
  }

  const Outline& outline_;
  std::vector<std::uint32_t> before_, after_;  ///< the neighbours of each corner
  std::vector<bool> isCut_;
  std::set<std::uint32_t> open_;                     ///< all ears, and corners that are not tested yet
  std::set<std::uint32_t> straight_;                 ///< collinear with their neighbours
  std::vector<std::vector<std::uint32_t>> blocked_;  ///< per corner: those in whose triangles it was found
  PointTree rest_;                                   ///< the corners that are not cut off
  double longest_;                                   ///< no two points are as far from each other
};

}  // namespace

glm::dvec3 newellNormal(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}

bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, bc = c - b;
  const double doubledArea = glm::length(glm::cross(ab, ac));
  const double longest = std::sqrt(std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)}));
  const std::array<glm::dvec3, 3> points{a, b, c};
  return doubledArea > heightNoise(points) * longest;
}

Triangulation triangulate(std::span<const glm::dvec3> polygon) {
  assert(polygon.size() >= 3);
  const auto corners = static_cast<std::uint32_t>(polygon.size());
  const glm::dvec3 normal = newellNormal(polygon);
  if (corners == 3) return {fan(corners)};
  if (!(glm::length(normal) > 0)) return {fan(corners), true};  // its loops cancel, or it has no area
  const Outline outline = projected(polygon, normal);
  if (isConvex(outline)) return {fan(corners)};
  return EarClipper(outline).clip();
}

}  // namespace hemitex::radiosity
