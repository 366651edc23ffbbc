/// 3D vectors with any number type: double, or wider numbers for sums with cancellation. (GLM's vectors accept only
/// built-in numbers.)
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace hemitex::reference {

template <typename Real>
struct WideVector {
  Real x, y, z;
};

/// Converts a GLM vector, exactly.
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

/// A number with an error bound. A result in double precision is used if its error is small enough; otherwise it is
/// computed again in wider arithmetic.
template <typename Real>
struct Estimate {
  Real value = 0;
  Real error = 0;  ///< upper bound of the error from rounding and quadrature

  /// Whether the value is positive and its relative error is at most this; true for an exact 0.
  bool isCertain(double relative = 1e-10) const { return error <= relative * value; }
};

}  // namespace hemitex::reference
