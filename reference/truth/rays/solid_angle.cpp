#include "reference/truth/rays/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "reference/truth/rays/sample_points.h"

namespace hemitex::reference {
namespace {

constexpr double smallSolidAngle = 1e-6;
/// Minimum barycentric weight of a direction inside a triangle.
constexpr double insideBy = 0x1p-24;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The direction at right angles to the unit vector `to`, on the side of `from`.
glm::dvec3 acrossFrom(const glm::dvec3& from, const glm::dvec3& to) {
  return glm::normalize(from - glm::dot(from, to) * to);
}

/// The point on the arc from `axis` to `towards` with this cosine to `axis`.
glm::dvec3 onArc(const glm::dvec3& axis, const glm::dvec3& towards, double cosine) {
  return cosine * axis + std::sqrt(std::max(0.0, 1 - cosine * cosine)) * acrossFrom(towards, axis);
}

/// Chooses a triangle of a fan from the cumulative sums of their sizes.
Choice chooseTriangle(std::span<const double> upTo, double x) { return choose(upTo, x, std::identity()); }

/// By area: a point of a flat triangle represents its area, with foreshortening and distance.
Aim aimByArea(std::span<const glm::dvec3> polygon, const glm::dvec3& point, double x, double y) {
  std::vector<double> upTo;
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    upTo.push_back(sum += glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0])) / 2);
  const Choice choice = chooseTriangle(upTo, x);
  const glm::dvec3 &a = polygon[0], &b = polygon[choice.index + 1], &c = polygon[choice.index + 2];
  const glm::dvec3 offset = a + std::sqrt(choice.within) * ((b - a) + y * (c - b)) - point;
  const double distance = glm::length(offset);
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const double foreshortening = std::abs(glm::dot(normal, offset)) / distance;
  return {offset / distance, sum * foreshortening / (distance * distance)};
}

/// The direction, or one just inside the triangle with these corners (relative to the point). If two corners are almost
/// opposite, as those of a sliver seen from its own width away, cosines have too few digits. Then one direction in a
/// few hundred would lie on the border or beyond it, where a ray meets a neighbour or nothing.
glm::dvec3 movedInside(const glm::dvec3& direction, const std::array<glm::dvec3, 3>& corner) {
  const auto& [a, b, c] = corner;
  const glm::dvec3 volume(glm::dot(direction, glm::cross(b, c)), glm::dot(direction, glm::cross(c, a)),
                          glm::dot(direction, glm::cross(a, b)));
  const glm::dvec3 weight = volume / (volume.x + volume.y + volume.z);
  if (std::min({weight.x, weight.y, weight.z}) >= insideBy) return direction;
  const glm::dvec3 inside = glm::max(weight, glm::dvec3(insideBy));
  return glm::normalize(inside.x * a + inside.y * b + inside.z * c);
}

}  // namespace

double solidAngle(const SphericalTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// An arc from b divides the triangle's area in the ratio x; its other end lies on the side from a to c. Along the arc,
/// area grows with 1 - cosine.
glm::dvec3 directionIn(const SphericalTriangle& triangle, double x, double y) {
  const auto& [a, b, c] = triangle;
  const double alpha = angleBetween(acrossFrom(b, a), acrossFrom(c, a));
  const double turn = x * solidAngle(triangle) - alpha;
  const double s = std::sin(turn), t = std::cos(turn);
  const double u = t - std::cos(alpha), v = s + std::sin(alpha) * glm::dot(a, b);
  const double cosine = ((v * t - u * s) * std::cos(alpha) - v) / ((v * s + u * t) * std::sin(alpha));
  const glm::dvec3 end = onArc(a, c, std::clamp(cosine, glm::dot(a, c), 1.0));
  return onArc(b, end, 1 - y * (1 - glm::dot(end, b)));
}

Aim aimInto(std::span<const glm::dvec3> polygon, const glm::dvec3& point, double x, double y) {
  std::vector<glm::dvec3> corner;
  for (const glm::dvec3& position : polygon) corner.push_back(glm::normalize(position - point));
  const auto triangle = [&](std::size_t i) { return SphericalTriangle{corner[0], corner[i + 1], corner[i + 2]}; };
  std::vector<double> upTo;
  double sum = 0;
  for (std::size_t i = 0; i + 2 < corner.size(); ++i) upTo.push_back(sum += solidAngle(triangle(i)));
  if (sum < smallSolidAngle) return aimByArea(polygon, point, x, y);
  const auto [i, within] = chooseTriangle(upTo, x);
  const std::array<glm::dvec3, 3> flat{polygon[0] - point, polygon[i + 1] - point, polygon[i + 2] - point};
  return {movedInside(directionIn(triangle(i), within, y), flat), sum};
}

}  // namespace hemitex::reference
