#include "reference/truth/closed_forms/point_to_polygon.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cassert>
#include <cmath>
#include <limits>

#include "reference/truth/closed_forms/extended_precision.h"

namespace hemitex::reference {
namespace {

using FiftyDigits = boost::multiprecision::cpp_bin_float_50;

/// The angle of a right triangle over its opposite side `size`; `along` is the adjacent side. Infinite if both are
/// zero, or if a straight angle leaves no side; sums with it are never certain.
template <typename Real>
Real angleOverSize(const Real& size, const Real& along) {
  using std::atan2;
  if (size > 0) return atan2(size, along) / size;
  return along > 0 ? Real(1 / along) : std::numeric_limits<Real>::infinity();
}

/// The contour of a polygon as seen from the origin, summed piece by piece.
template <typename Real>
struct Contour {
  WideVector<Real> normal;
  Real sum = 0;
  Real ratios = 0;         ///< sum of angle over size, for all pieces of edges
  Real horizonRatios = 0;  ///< times the distances of both ends, for the pieces of the horizon

  /// Adds the piece from `start` to `end`; `part` is the share of the edge, which starts at `corner`.
  void addEdge(const WideVector<Real>& corner, const WideVector<Real>& edge, const WideVector<Real>& start,
               const WideVector<Real>& end, const Real& part) {
    const WideVector<Real> product = cross(corner, edge);
    const Real ratio = part * angleOverSize(Real(part * length(product)), dot(start, end));
    sum -= ratio * dot(normal, product);
    ratios += ratio;
  }

  /// Adds the piece of the horizon between the two points where the contour crosses it.
  void addHorizon(const WideVector<Real>& start, const WideVector<Real>& end) {
    using std::abs;
    const Real product = dot(normal, cross(start, end));
    const Real ratio = angleOverSize(Real(abs(product)), dot(start, end));
    sum -= ratio * product;
    horizonRatios += ratio * (length(start) + length(end));
  }
};

/// The lengths that bound the rounding error of a contour, and its highest point.
template <typename Real>
struct Bounds {
  Real reach = 0;    ///< the distance of the farthest corner
  Real edge = 0;     ///< the length of the longest edge
  Real highest = 0;  ///< the largest height of a corner above the horizon
};

template <typename Real>
WideVector<Real> from(const glm::dvec3& point, const glm::dvec3& corner) {
  return widen<Real>(corner) - widen<Real>(point);
}

template <typename Real>
Bounds<Real> boundsOf(const glm::dvec3& point, const WideVector<Real>& normal, std::span<const glm::dvec3> polygon) {
  using std::max;
  using std::sqrt;
  Bounds<Real> bounds;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &first = polygon[i], &second = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const WideVector<Real> r = from<Real>(point, first), edge = from<Real>(first, second);
    bounds.reach = max(bounds.reach, dot(r, r));
    bounds.edge = max(bounds.edge, dot(edge, edge));
    bounds.highest = max(bounds.highest, dot(normal, r));
  }
  bounds.reach = sqrt(bounds.reach);
  bounds.edge = sqrt(bounds.edge);
  return bounds;
}

/// Lambert's sum over 2 pi; it is negative if the polygon shows its back.
template <typename Real>
Estimate<Real> contourIntegral(const glm::dvec3& point, const glm::dvec3& unitNormal,
                               std::span<const glm::dvec3> polygon) {
  Contour<Real> contour{widen<Real>(unitNormal)};
  const Bounds<Real> bounds = boundsOf(point, contour.normal, polygon);
  if (bounds.highest <= 4 * std::numeric_limits<double>::epsilon() * bounds.reach) return {};

  WideVector<Real> sinks{}, rises{};
  bool isCut = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &first = polygon[i], &second = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const WideVector<Real> a = from<Real>(point, first), b = from<Real>(point, second),
                           edge = from<Real>(first, second);
    const Real heightA = dot(contour.normal, a), heightB = dot(contour.normal, b);
    if (heightA <= 0 && heightB <= 0) continue;
    if (heightA > 0 && heightB > 0) {
      contour.addEdge(a, edge, a, b, 1);
      continue;
    }
    isCut = true;
    const Real t = heightA / (heightA - heightB);
    const WideVector<Real> crossing = a + t * edge;
    if (heightA > 0) {
      contour.addEdge(a, edge, a, crossing, t);
      sinks = crossing;
    } else {
      contour.addEdge(a, edge, crossing, b, 1 - t);
      rises = crossing;
    }
  }
  if (isCut) contour.addHorizon(sinks, rises);
  const Real twoPi = boost::math::constants::two_pi<Real>();
  const Real error = bounds.reach * (bounds.edge * contour.ratios + contour.horizonRatios);
  return {contour.sum / twoPi, 4 * std::numeric_limits<Real>::epsilon() * error / twoPi};
}

}  // namespace

double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal, std::span<const glm::dvec3> polygon,
                      double absoluteError) {
  assert(polygon.size() >= 3);
  const Estimate<double> fast = contourIntegral<double>(point, normal, polygon);
  if (fast.isCertain() || fast.error <= absoluteError) return std::max(fast.value, 0.0);
  if (fast.value < -fast.error) return 0;
  const Estimate<FiftyDigits> careful = contourIntegral<FiftyDigits>(point, normal, polygon);
  return careful.isCertain() ? static_cast<double>(careful.value) : 0;
}

}  // namespace hemitex::reference
