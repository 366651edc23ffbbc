#include "radiosity/geometry/triangulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace hemitex::radiosity {
namespace {

using Ring = std::vector<std::uint32_t>;

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

glm::dvec3 newellNormal(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return sum;
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

/// The corner at `at` of the ring with its two neighbours.
std::array<std::uint32_t, 3> cornerTriangle(const Ring& ring, std::size_t at) {
  return {ring[(at + ring.size() - 1) % ring.size()], ring[at], ring[(at + 1) % ring.size()]};
}

bool holdsCorner(const Outline& outline, const Ring& ring, const std::array<std::uint32_t, 3>& triangle) {
  const auto [a, b, c] = triangle;
  const auto isCornerOf = [&, a = a, b = b, c = c](const glm::dvec2& p) {
    return p == outline.points[a] || p == outline.points[b] || p == outline.points[c];
  };
  for (const std::uint32_t q : ring) {
    if (isCornerOf(outline.points[q])) continue;
    if (turn(outline, a, b, q) >= 0 && turn(outline, b, c, q) >= 0 && turn(outline, c, a, q) >= 0) return true;
  }
  return false;
}

/// Cuts off ears. After a round without an ear, collinear corners are accepted. After another such round, which happens
/// only for a polygon that crosses itself, any corner is accepted.
Triangulation clipEars(const Outline& outline) {
  Triangulation result;
  Ring ring(outline.points.size());
  std::iota(ring.begin(), ring.end(), 0u);
  std::size_t at = 0, refused = 0;
  while (ring.size() > 3) {
    const std::array<std::uint32_t, 3> triangle = cornerTriangle(ring, at);
    const int turned = turn(outline, triangle[0], triangle[1], triangle[2]);
    const bool isEar = turned > 0 && !holdsCorner(outline, ring, triangle);
    const bool isStraight = turned == 0 && refused >= ring.size();
    const bool isForced = refused >= 2 * ring.size();
    if (isEar || isStraight || isForced) {
      result.triangles.push_back(triangle);
      result.crossing = result.crossing || !(isEar || isStraight);
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
      refused = 0;
    } else {
      ++at;
      ++refused;
    }
    at %= ring.size();
  }
  result.crossing = result.crossing || turn(outline, ring[0], ring[1], ring[2]) < 0;
  result.triangles.push_back({ring[0], ring[1], ring[2]});
  return result;
}

}  // namespace

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
  return clipEars(outline);
}

}  // namespace hemitex::radiosity
