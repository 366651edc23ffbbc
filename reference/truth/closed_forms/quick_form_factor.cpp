#include "reference/truth/closed_forms/quick_form_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "radiosity/geometry/convex_part.h"
#include "radiosity/geometry/triangulation.h"
#include "reference/truth/closed_forms/polygon_to_polygon.h"

namespace hemitex::reference {
namespace {

using radiosity::ConvexPart;
using radiosity::fromPoint;
using radiosity::inFrontOf;

glm::dvec3 areaVector(std::span<const glm::dvec3> polygon) { return 0.5 * radiosity::newellNormal(polygon); }

glm::dvec3 middleOf(const ConvexPart& part) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& corner : part.span()) sum += corner;
  return sum / static_cast<double>(part.count);
}

double radiusOf(const ConvexPart& part, const glm::dvec3& middle) {
  double radius = 0;
  for (const glm::dvec3& corner : part.span()) radius = std::max(radius, glm::distance(middle, corner));
  return radius;
}

/// A point of a rule over a triangle: the weights of the corners, and its share of the area.
struct RulePoint {
  double a, b, c, share;
};

constexpr double third = 1.0 / 3;
/// Of degrees 2 and 5.
constexpr std::array<RulePoint, 3> threePoints{{{2 * third, third / 2, third / 2, third},
                                                {third / 2, 2 * third, third / 2, third},
                                                {third / 2, third / 2, 2 * third, third}}};
constexpr double p = 0.470142064105115, q = 0.101286507323456, pShare = 0.132394152788506, qShare = 0.125939180544827;
constexpr std::array<RulePoint, 7> sevenPoints{{{third, third, third, 0.225},
                                                {1 - 2 * p, p, p, pShare},
                                                {p, 1 - 2 * p, p, pShare},
                                                {p, p, 1 - 2 * p, pShare},
                                                {1 - 2 * q, q, q, qShare},
                                                {q, 1 - 2 * q, q, qShare},
                                                {q, q, 1 - 2 * q, qShare}}};

/// Calls visit(point, area) for the points of a rule over a polygon.
template <typename Visit>
void forEachPoint(const ConvexPart& polygon, std::span<const RulePoint> rule, const Visit& visit) {
  for (std::size_t k = 2; k < polygon.count; ++k) {
    const std::array<glm::dvec3, 3> triangle{polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]};
    const double area = glm::length(areaVector(triangle));
    for (const RulePoint& point : rule)
      visit(point.a * triangle[0] + point.b * triangle[1] + point.c * triangle[2], area * point.share);
  }
}

/// The integral over a polygon of the form factor from its points to another polygon.
double integralOver(const ConvexPart& from, const glm::dvec3& normal, const ConvexPart& to,
                    std::span<const RulePoint> rule) {
  double sum = 0;
  forEachPoint(from, rule, [&](const glm::dvec3& point, double share) { sum += share * fromPoint(point, normal, to); });
  return sum;
}

/// The integral over two distant polygons of cos cos / (pi r^2).
double integralOverBoth(const ConvexPart& from, const glm::dvec3& fromNormal, const ConvexPart& to,
                        const glm::dvec3& toNormal) {
  double sum = 0;
  forEachPoint(from, threePoints, [&](const glm::dvec3& start, double fromShare) {
    forEachPoint(to, threePoints, [&](const glm::dvec3& end, double toShare) {
      const glm::dvec3 way = end - start;
      const double squared = glm::dot(way, way);
      const double cosines = glm::dot(fromNormal, way) * -glm::dot(toNormal, way);
      sum += fromShare * toShare * std::max(cosines, 0.0) / (squared * squared);
    });
  });
  return sum * std::numbers::inv_pi;
}

}  // namespace

double quickFormFactor(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
  const glm::dvec3 fromArea = areaVector(from), toArea = areaVector(to);
  const double area = glm::length(fromArea);
  const glm::dvec3 fromNormal = fromArea / area, toNormal = glm::normalize(toArea);
  const ConvexPart fromFront = inFrontOf(from, to[0], toNormal), toFront = inFrontOf(to, from[0], fromNormal);
  if (fromFront.count < 3 || toFront.count < 3) return 0;
  const glm::dvec3 fromMiddle = middleOf(fromFront), toMiddle = middleOf(toFront);
  const double fromRadius = radiusOf(fromFront, fromMiddle), toRadius = radiusOf(toFront, toMiddle);
  const bool fromIsSmaller = fromRadius < toRadius;
  const double smaller = std::min(fromRadius, toRadius);
  const double gap = glm::distance(fromMiddle, toMiddle) - fromRadius - toRadius;
  if (gap < smaller) return polygonToPolygon(from, to, {.relative = 1e-6, .absolute = 1e-10});
  if (gap > 6 * std::max(fromRadius, toRadius))
    return integralOverBoth(fromFront, fromNormal, toFront, toNormal) / area;
  const std::span<const RulePoint> rule =
      gap > 6 * smaller ? std::span<const RulePoint>(threePoints) : std::span<const RulePoint>(sevenPoints);
  const double integral = fromIsSmaller ? integralOver(fromFront, fromNormal, toFront, rule)
                                        : integralOver(toFront, toNormal, fromFront, rule);
  return integral / area;
}

double quickFormFactor(const ConvexPolygons& from, const ConvexPolygons& to) {
  double sum = 0, area = 0;
  for (const std::vector<glm::dvec3>& a : from) {
    const double areaOfA = glm::length(areaVector(a));
    area += areaOfA;
    for (const std::vector<glm::dvec3>& b : to) sum += areaOfA * quickFormFactor(a, b);
  }
  return sum / area;
}

}  // namespace hemitex::reference
