#include "radiosity/form_factors/polygon_form_factor.h"

#include <cmath>
#include <numbers>

namespace hemitex::radiosity {
namespace {

/// An angle from 0 to pi over its sine, both times the same length; 0 for the straight angle.
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

/// The term of one piece of the contour.
double termOf(const glm::dvec3& normal, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 product = glm::cross(from, to);
  return angleOverSine(glm::length(product), glm::dot(from, to)) * glm::dot(normal, product);
}

}  // namespace

double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal, std::span<const glm::dvec3> polygon) {
  double sum = 0;
  glm::dvec3 sinks(0), rises(0);
  bool isCut = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - point, b = polygon[i + 1 < polygon.size() ? i + 1 : 0] - point;
    const double heightA = glm::dot(normal, a), heightB = glm::dot(normal, b);
    if (heightA <= 0 && heightB <= 0) continue;
    if (heightA > 0 && heightB > 0) {
      sum += termOf(normal, a, b);
      continue;
    }
    isCut = true;
    const glm::dvec3 crossing = a + heightA / (heightA - heightB) * (b - a);
    (heightA > 0 ? sinks : rises) = crossing;
    sum += heightA > 0 ? termOf(normal, a, crossing) : termOf(normal, crossing, b);
  }
  if (isCut) sum += termOf(normal, sinks, rises);
  return std::abs(sum) / (2 * std::numbers::pi);
}

}  // namespace hemitex::radiosity
