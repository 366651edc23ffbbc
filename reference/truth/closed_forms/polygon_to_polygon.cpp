#include "reference/truth/closed_forms/polygon_to_polygon.h"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "reference/truth/closed_forms/extended_precision.h"
#include "reference/truth/closed_forms/point_to_polygon.h"

namespace hemitex::reference {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_quad;
using Polygon = std::vector<glm::dvec3>;

struct Plane {
  glm::dvec3 point, normal;
  double area;  ///< of the original polygon
};

/// Twice the vector area of a polygon (Newell), and the square of the distance of the corner farthest from the first.
struct Newell {
  glm::dvec3 normal{0};
  double reach = 0;
};

Newell newellOf(std::span<const glm::dvec3> polygon) {
  Newell result;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const glm::dvec3 last = polygon[i - 1] - polygon[0], next = polygon[i] - polygon[0];
    result.normal += glm::cross(last, next);
    result.reach = std::max(result.reach, glm::dot(next, next));
  }
  return result;
}

/// In double precision the relative error of the normal is that of a double over the sliver's ratio of area to reach.
/// So slivers take wide numbers, unless the ratio is above `sliver`.
Plane planeOf(std::span<const glm::dvec3> polygon, double sliver = 0.05) {
  const Newell quick = newellOf(polygon);
  if (const double twice = glm::length(quick.normal); twice > sliver * quick.reach)
    return {polygon[0], quick.normal / twice, twice / 2};
  WideVector<Wide> sum{};
  const WideVector<Wide> origin = widen<Wide>(polygon[0]);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum = sum + cross(widen<Wide>(polygon[i - 1]) - origin, widen<Wide>(polygon[i]) - origin);
  const Wide size = length(sum);
  assert(size > 0);
  const auto component = [&](const Wide& value) { return static_cast<double>(value / size); };
  return {polygon[0], {component(sum.x), component(sum.y), component(sum.z)}, static_cast<double>(size / 2)};
}

/// The part of a polygon in front of a plane. Heights up to `slack` count as 0. Otherwise polygons that are coplanar up
/// to rounding would need wide numbers in all rules, for a result of zero.
Polygon inFrontOf(const Plane& plane, const Polygon& polygon, double slack) {
  const auto heightOf = [&](const glm::dvec3& corner) {
    const double height = glm::dot(plane.normal, corner - plane.point);
    return std::abs(height) <= slack ? 0.0 : height;
  };
  Polygon front;
  double highest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double heightA = heightOf(a), heightB = heightOf(b);
    highest = std::max(highest, heightA);
    if (heightA >= 0) front.push_back(a);
    if ((heightA > 0 && heightB < 0) || (heightA < 0 && heightB > 0))
      front.push_back(a + heightA / (heightA - heightB) * (b - a));
  }
  if (highest == 0) front.clear();
  return front;
}

double distanceToSegment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double t = std::clamp(glm::dot(point - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
  return glm::distance(point, a + t * edge);
}

/// The distance from a point to a convex polygon.
double distanceTo(const Polygon& polygon, const Plane& plane, const glm::dvec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  bool isAbove = true;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    nearest = std::min(nearest, distanceToSegment(point, a, b));
    isAbove = isAbove && glm::dot(glm::cross(plane.normal, b - a), point - a) >= 0;
  }
  return isAbove ? std::abs(glm::dot(plane.normal, point - plane.point)) : nearest;
}

glm::dvec3 middleOf(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

double radiusOf(const Polygon& polygon) {
  const glm::dvec3 middle = middleOf(polygon);
  double radius = 0;
  for (const glm::dvec3& corner : polygon) radius = std::max(radius, glm::distance(middle, corner));
  return radius;
}

/// The integral over a triangle of the form factor from its points, by Gauss' rule with `points` x `points` points.
/// These are a + s (b - a) + s t (c - b), with s and t in [0, 1] and the Jacobian 2 area s.
template <unsigned points>
double integralOverTriangle(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& normal, const Polygon& to,
                            double absoluteError) {
  using Rule = boost::math::quadrature::gauss<double, points>;
  const glm::dvec3 first = triangle[1] - triangle[0], second = triangle[2] - triangle[1];
  const auto alongS = [&](double s) {
    const auto alongT = [&](double t) {
      return pointToPolygon(triangle[0] + s * (first + t * second), normal, to, absoluteError);
    };
    return s * Rule::integrate(alongT, 0.0, 1.0);
  };
  return 2 * planeOf(triangle).area * Rule::integrate(alongS, 0.0, 1.0);
}

/// Calls visit(n) with the size of a Gauss rule, a constant, over an interval whose integrand is smooth in `apart`
/// halves of the interval from its middle, above 1. The error of n points falls as (apart + sqrt(apart^2 - 1))^(-2n);
/// it is below `tolerance`, at least 1e-17, if `apart` is at least 2.
template <typename Visit>
auto withGaussPoints(double apart, double tolerance, const Visit& visit) {
  const double needed = -std::log(tolerance) / (2 * std::log(apart + std::sqrt(apart * apart - 1)));
  if (needed <= 4) return visit(std::integral_constant<unsigned, 4>());
  if (needed <= 5) return visit(std::integral_constant<unsigned, 5>());
  if (needed <= 7) return visit(std::integral_constant<unsigned, 7>());
  if (needed <= 10) return visit(std::integral_constant<unsigned, 10>());
  return visit(std::integral_constant<unsigned, 15>());
}

/// The integral over a polygon. `apart` is the distance of `to` from its middle over its radius, at least 3.
double integralOver(const Polygon& polygon, const glm::dvec3& normal, const Polygon& to, double apart,
                    const FormFactorAccuracy& accuracy) {
  return withGaussPoints(apart, 0.01 * accuracy.relative, [&](auto points) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
      sum += integralOverTriangle<points()>({polygon[0], polygon[i - 1], polygon[i]}, normal, to, accuracy.absolute);
    return sum;
  });
}

template <typename Real>
struct Edge {
  WideVector<Real> start, end, direction;
  Real length;
};

template <typename Real>
std::vector<Edge<Real>> edgesOf(const Polygon& polygon) {
  std::vector<Edge<Real>> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const WideVector<Real> start = widen<Real>(polygon[i]), end = widen<Real>(polygon[(i + 1) % polygon.size()]);
    const Real size = length(end - start);
    if (size > 0) edges.push_back({start, end, Real(1 / size) * (end - start), size});
  }
  return edges;
}

/// The integral of ln |x - y| over the points y of an edge, up to a multiple of its length; such multiples cancel
/// around the contour of x.
template <typename Real>
Real logarithmOver(const Edge<Real>& edge, const WideVector<Real>& x) {
  using std::atan2;
  using std::log;
  const WideVector<Real> toStart = edge.start - x;
  const Real low = dot(toStart, edge.direction), high = low + edge.length;
  const Real apart = length(cross(toStart, edge.direction));
  const auto upTo = [&](const Real& along) -> Real {
    const Real squared = along * along + apart * apart;
    return squared > 0 ? Real(along * log(squared) / 2) : Real(0);
  };
  return upTo(high) - upTo(low) + apart * atan2(apart * edge.length, apart * apart + low * high);
}

/// The points where the integrand along `outer` is not smooth, as shares of its length: its two ends, the points
/// nearest to the ends of `inner`, and the point nearest to its line.
template <typename Real>
std::vector<Real> cutsAlong(const Edge<Real>& outer, const Edge<Real>& inner) {
  std::vector<Real> cuts{0, 1};
  const auto addCut = [&](const Real& along) {
    const Real share = along / outer.length;
    if (share > 0 && share < 1) cuts.push_back(share);
  };
  const WideVector<Real> toStart = inner.start - outer.start;
  const Real alongOuter = dot(toStart, outer.direction), cosine = dot(outer.direction, inner.direction);
  addCut(alongOuter);
  addCut(dot(inner.end - outer.start, outer.direction));
  const Real squaredSine = 1 - cosine * cosine;
  if (squaredSine > 0) addCut((alongOuter - cosine * dot(toStart, inner.direction)) / squaredSine);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// The same over the points x and y of two parallel edges. With the distance d of their lines, and differences u of
/// places along them, the second antiderivative of ln(u^2 + d^2) / 2 is
///   (u^2 - d^2) ln(u^2 + d^2) / 4 + d u atan(u / d) - 3 u^2 / 4.
template <typename Real>
Estimate<Real> logarithmOverParallel(const Edge<Real>& outer, const Edge<Real>& inner) {
  using std::abs;
  using std::atan2;
  using std::log;
  using std::max;
  using std::min;
  const WideVector<Real> toStart = inner.start - outer.start;
  const Real apart = length(cross(toStart, outer.direction));
  const Real first = dot(toStart, outer.direction), second = dot(inner.end - outer.start, outer.direction);
  const Real low = min(first, second), high = max(first, second);
  Estimate<Real> total{-outer.length * inner.length / 2, 0};
  const auto add = [&](const Real& u, int sign) {
    const Real squared = u * u + apart * apart;
    if (squared == 0) return;
    const Real logarithm = log(squared) / 4;
    total.value += sign * ((u * u - apart * apart) * logarithm + apart * u * atan2(u, apart));
    total.error += squared * (2 + abs(logarithm));
  };
  add(high, 1);
  add(high - outer.length, -1);
  add(low, -1);
  add(low - outer.length, 1);
  total.error *= 4 * std::numeric_limits<Real>::epsilon();
  return total;
}

/// The same over the points x and y of two edges that are apart: the nearest point of `inner` to the middle of `outer`
/// is `apart` halves of it away, at least 2.
Estimate<double> logarithmOverDistant(const Edge<double>& outer, const Edge<double>& inner, double apart,
                                      double tolerance) {
  return withGaussPoints(apart, tolerance, [&](auto points) {
    double size = 0;
    const auto along = [&](double t) {
      const double value = logarithmOver(inner, outer.start + t * (outer.end - outer.start));
      size = std::max(size, std::abs(value));
      return value;
    };
    const double integral = boost::math::quadrature::gauss<double, points()>::integrate(along, 0.0, 1.0);
    const double error = tolerance * inner.length + 8 * std::numeric_limits<double>::epsilon() * (size + inner.length);
    return Estimate<double>{outer.length * integral, outer.length * error};
  });
}

/// The same over the points x and y of any two edges.
template <typename Real>
Estimate<Real> logarithmOverNear(const Edge<Real>& outer, const Edge<Real>& inner, const Real& tolerance) {
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  // The integrands are bounded, so that the rule need not come nearer to the ends than this. Each thread has a rule of
  // its own: Boost announces a finer step before it has computed all its points.
  thread_local boost::math::quadrature::tanh_sinh<Real> rule(12, epsilon * epsilon);
  Estimate<Real> total;
  const std::vector<Real> cuts = cutsAlong(outer, inner);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const Real middle = (cuts[i - 1] + cuts[i]) / 2, half = (cuts[i] - cuts[i - 1]) / 2;
    if (half == 0) continue;
    const auto along = [&](const Real& t) {
      return logarithmOver(inner, outer.start + (middle + half * t) * (outer.end - outer.start));
    };
    Real error = 0, size = 0;
    const Real integral = rule.integrate(along, tolerance, &error, &size);
    total.value += half * outer.length * integral;
    total.error += half * outer.length * (error + 8 * epsilon * (size + inner.length));
  }
  return total;
}

glm::dvec3 narrow(const WideVector<double>& v) { return {v.x, v.y, v.z}; }

/// The integral of ln |x - y| over the points x and y of two edges, up to terms of one edge alone.
template <typename Real>
Estimate<Real> logarithmOverBoth(const Edge<Real>& a, const Edge<Real>& b, const Real& tolerance) {
  const Edge<Real>&outer = a.length < b.length ? a : b, &inner = a.length < b.length ? b : a;
  if constexpr (std::is_same_v<Real, double>) {
    const glm::dvec3 middle = narrow(0.5 * (outer.start + outer.end));
    const double apart = 2 * distanceToSegment(middle, narrow(inner.start), narrow(inner.end)) / outer.length;
    if (apart >= 2) return logarithmOverDistant(outer, inner, apart, tolerance);
  }
  // Turning one edge until both are parallel moves no point by more than the sine times a length.
  const Real sine = length(cross(outer.direction, inner.direction));
  if (sine > tolerance / 32) return logarithmOverNear(outer, inner, tolerance);
  Estimate<Real> parallel = logarithmOverParallel(outer, inner);
  parallel.error += 4 * sine * outer.length * inner.length;
  return parallel;
}

/// The contour integral over 2 pi: area times form factor. `tolerance` is the relative error of the rules, and the
/// cosine and the sine up to which edges are perpendicular and parallel.
template <typename Real>
Estimate<Real> contourIntegral(const Polygon& from, const Polygon& to, const Real& tolerance) {
  using std::abs;
  const Real twoPi = boost::math::constants::two_pi<Real>();
  Estimate<Real> total;
  const std::vector<Edge<Real>> edgesOfTo = edgesOf<Real>(to);
  for (const Edge<Real>& a : edgesOf<Real>(from))
    for (const Edge<Real>& b : edgesOfTo) {
      const Real cosine = dot(a.direction, b.direction), size = abs(cosine);
      if (size <= tolerance / 32) {
        total.error += 8 * size * a.length * b.length;  // logarithms of distances are mostly below 40
        continue;
      }
      const Estimate<Real> integral = logarithmOverBoth(a, b, tolerance);
      total.value += cosine * integral.value / twoPi;
      total.error += size * integral.error / twoPi;
    }
  return total;
}

/// The area of one polygon times its form factor to the other; each lies completely in front of the plane of the other.
/// The absolute error that is accepted is that of the area times the form factor.
double exchangeArea(const Polygon& a, const Plane& planeA, const Polygon& b, const Plane& planeB,
                    const FormFactorAccuracy& accuracy) {
  const bool isSmallerA = radiusOf(a) < radiusOf(b);
  const Polygon &smaller = isSmallerA ? a : b, &larger = isSmallerA ? b : a;
  const Plane &ofSmaller = isSmallerA ? planeA : planeB, &ofLarger = isSmallerA ? planeB : planeA;
  const double apart = distanceTo(larger, ofLarger, middleOf(smaller)) / radiusOf(smaller);
  if (apart >= 3)
    return integralOver(smaller, ofSmaller.normal, larger, apart,
                        {accuracy.relative, accuracy.absolute / ofSmaller.area});
  const double finest = 64 * std::numeric_limits<double>::epsilon();
  const double coarser = 1e-4 * accuracy.relative;
  for (const double tolerance : {std::max(coarser, finest), finest}) {
    const Estimate<double> fast = contourIntegral<double>(a, b, tolerance);
    if (fast.isCertain(accuracy.relative) || fast.error <= accuracy.absolute) return std::max(fast.value, 0.0);
    if (coarser <= finest) break;
  }
  const Estimate<Wide> careful = contourIntegral<Wide>(a, b, 64 * std::numeric_limits<Wide>::epsilon());
  return careful.isCertain() ? static_cast<double>(careful.value) : 0;
}

/// Moves and scales the polygon, so that the farthest corner of both is at a distance of about 1.
Polygon moved(std::span<const glm::dvec3> polygon, const glm::dvec3& origin, double unit) {
  Polygon result;
  for (const glm::dvec3& corner : polygon) result.push_back((corner - origin) / unit);
  return result;
}

/// The distance of the farthest corner from `origin`, rounded to a power of two, so that dividing by it is exact.
double extentFrom(const glm::dvec3& origin, std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double extent = 0;
  for (const auto& polygon : {a, b})
    for (const glm::dvec3& corner : polygon) extent = std::max(extent, glm::distance(origin, corner));
  return std::exp2(std::round(std::log2(extent)));
}

/// Whether all of `polygon` is certainly behind the plane of `other`. Coordinates are up to about 1, so that rounding
/// moves a height times the length of the normal, which is twice an area, by less than 1e-13.
bool isBehind(const Polygon& polygon, const Polygon& other) {
  const glm::dvec3 normal = newellOf(other).normal;
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const glm::dvec3& corner) { return glm::dot(normal, corner - other[0]) < -1e-12; });
}

}  // namespace

double polygonToPolygon(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to,
                        const FormFactorAccuracy& accuracy) {
  assert(from.size() >= 3 && to.size() >= 3);
  const double unit = extentFrom(from[0], from, to);
  const Polygon a = moved(from, from[0], unit), b = moved(to, from[0], unit);
  if (isBehind(a, b) || isBehind(b, a)) return 0;
  const double sliver = std::clamp(5e-12 / accuracy.relative, 1e-5, 0.05);
  const Plane planeA = planeOf(a, sliver), planeB = planeOf(b, sliver);
  const double slack = 1e-13;
  const Polygon frontA = inFrontOf(planeB, a, slack), frontB = inFrontOf(planeA, b, slack);
  if (frontA.size() < 3 || frontB.size() < 3) return 0;
  return exchangeArea(frontA, planeA, frontB, planeB, {accuracy.relative, accuracy.absolute * planeA.area}) /
         planeA.area;
}

}  // namespace hemitex::reference
