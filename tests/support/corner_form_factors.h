/// Closed forms from a point to rectangles at distance 1 (Howell's catalogue, B-4 and B-3).
#pragma once

#include <cmath>

namespace hemitex::tests {

/// The form factor from a point to a parallel rectangle a x b at distance 1 with a corner on the normal. And to a
/// rectangle that stands on the horizon at distance 1, a high and b wide from the foot of the perpendicular.
inline double toParallel(double a, double b) {
  const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * M_PI);
}
inline double toPerpendicular(double a, double b) {
  const double s = std::sqrt(a * a + 1);
  return (std::atan(b) - std::atan(b / s) / s) / (2 * M_PI);
}

/// The integral over one pixel: inclusion and exclusion of the rectangles from the axis to its four corners.
template <typename Corner>
double pixel(const Corner& corner, double x0, double x1, double y0, double y1) {
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

}  // namespace hemitex::tests
