/// Form factors by quadrature: their definition as an integral over areas, by Gauss' rule. Accurate to 1e-13 if the
/// distance of the shapes is about their size.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace hemitex::tests {

struct Parallelogram {
  glm::dvec3 corner, u, v;  ///< counter-clockwise in front: the normal is u x v

  glm::dvec3 at(double s, double t) const { return corner + s * u + t * v; }
  glm::dvec3 areaVector() const { return glm::cross(u, v); }  ///< along the normal
  double area() const { return glm::length(areaVector()); }
  std::vector<glm::dvec3> corners() const { return {at(0, 0), at(1, 0), at(1, 1), at(0, 1)}; }
  Parallelogram reversed() const { return {corner, v, u}; }
};

/// The integral of a function over the unit square.
template <typename Function>
double overUnitSquare(const Function& function) {
  using Rule = boost::math::quadrature::gauss<double, 15>;
  return Rule::integrate([&](double s) { return Rule::integrate([&](double t) { return function(s, t); }, 0.0, 1.0); },
                         0.0, 1.0);
}

/// cos cos / (pi r^2), integrated over the parallelogram, which must be completely above the horizon and show its
/// front.
inline double bruteForce(const glm::dvec3& point, const glm::dvec3& normal, const Parallelogram& to) {
  const glm::dvec3 away = to.areaVector();
  return overUnitSquare([&](double s, double t) {
    const glm::dvec3 r = to.at(s, t) - point;
    const double squared = glm::dot(r, r);
    return glm::dot(normal, r) * -glm::dot(away, r) / (std::numbers::pi * squared * squared);
  });
}

inline double bruteForce(const Parallelogram& from, const Parallelogram& to) {
  const glm::dvec3 normal = glm::normalize(from.areaVector());
  return overUnitSquare([&](double s, double t) { return bruteForce(from.at(s, t), normal, to); });
}

inline double relativeError(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

}  // namespace hemitex::tests
