/// Vectors in space of any arithmetic: binary64, or wider numbers for sums that cancel. (GLM's vectors take built-in
/// numbers only.)
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace hemitex::reference {

template <typename Real>
struct WideVector {
  Real x, y, z;
};

/// Of a GLM vector, exactly.
template <typename Real>
WideVector<Real> widen(const glm::dvec3& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}

template <typename Real>
WideVector<Real> operator+(const WideVector<Real>& a, const WideVector<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <typename Real>
WideVector<Real> operator-(const WideVector<Real>& a, const WideVector<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <typename Real>
WideVector<Real> operator*(const Real& s, const WideVector<Real>& v) {
  return {s * v.x, s * v.y, s * v.z};
}

template <typename Real>
Real dot(const WideVector<Real>& a, const WideVector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename Real>
WideVector<Real> cross(const WideVector<Real>& a, const WideVector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename Real>
Real length(const WideVector<Real>& v) {
  using std::sqrt;
  return sqrt(dot(v, v));
}

/// A number that knows how wrong it may be: what is computed in double precision is kept where that suffices, and
/// computed again in wider arithmetic where it does not.
template <typename Real>
struct Estimate {
  Real value = 0;
  Real error = 0;  ///< how far rounding and the rule may have moved it, at most

  /// Whether it is positive, and right to 1e-10 of itself; true for an exact 0.
  bool isCertain() const { return error <= 1e-10 * value; }
};

}  // namespace hemitex::reference
