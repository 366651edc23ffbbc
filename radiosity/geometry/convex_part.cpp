#include "radiosity/geometry/convex_part.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace hemitex::radiosity {
namespace {

/// An angle from 0 to pi over its sine, both times the same length; 0 for the straight angle. Without the atan2 of a
/// library, whose last bit is not the same everywhere.
double angleOverSine(double sine, double cosine) {
  if (!(sine > 0)) return cosine > 0 ? 1 / cosine : 0;
  const double length = std::sqrt(sine * sine + cosine * cosine);
  double tangent = cosine > 0 ? sine / (length + cosine) : (length - cosine) / sine;  // of half of the angle
  double parts = 2;
  for (; tangent > 0.2; parts *= 2) tangent /= 1 + std::sqrt(1 + tangent * tangent);
  // The series of the arctangent; the next term is below 2^-53.
  double sum = 0;
  for (int power = 21; power > 0; power -= 2) sum = 1.0 / power - tangent * tangent * sum;
  return parts * tangent * sum / sine;
}

}  // namespace

ConvexPart inFrontOf(std::span<const glm::dvec3> polygon, const glm::dvec3& point, const glm::dvec3& normal) {
  std::array<double, 7> heights{};
  assert(polygon.size() <= heights.size());
  double largest = 0, highest = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    heights[k] = glm::dot(normal, polygon[k] - point);
    largest = std::max(largest, glm::distance(polygon[k], point));
  }
  const double slack = 1e-13 * largest;
  for (double& height : heights) {
    if (std::abs(height) <= slack) height = 0;
    highest = std::max(highest, height);
  }
  ConvexPart part;
  if (highest <= 0) return part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (heights[k] >= 0) part.corners[part.count++] = polygon[k];
    if ((heights[k] > 0 && heights[next] < 0) || (heights[k] < 0 && heights[next] > 0))
      part.corners[part.count++] =
          polygon[k] + heights[k] / (heights[k] - heights[next]) * (polygon[next] - polygon[k]);
  }
  return part;
}

ConvexPart inFrontOf(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& point, const glm::dvec3& normal) {
  return inFrontOf(std::span<const glm::dvec3>(triangle), point, normal);
}

double fromPoint(const glm::dvec3& point, const glm::dvec3& normal, const ConvexPart& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const glm::dvec3 a = polygon.corners[k] - point, b = polygon.corners[(k + 1) % polygon.count] - point;
    const glm::dvec3 product = glm::cross(b, a);
    sum += angleOverSine(glm::length(product), glm::dot(a, b)) * glm::dot(normal, product);
  }
  return std::max(sum * 0.5 * std::numbers::inv_pi, 0.0);
}

}  // namespace hemitex::radiosity
