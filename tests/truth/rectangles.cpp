#include "tests/truth/rectangles.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cassert>

namespace hemitex::tests {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

Wide twoPi() { return boost::math::constants::two_pi<Wide>(); }

/// x atan(x / p) times p, with the limit 0 at p = 0.
Wide productWithAngle(const Wide& x, const Wide& p) { return p == 0 ? Wide(0) : Wide(x * p * atan(x / p)); }

Wide parallelTerm(const Wide& u, const Wide& v, const Wide& z) {
  return (productWithAngle(u, sqrt(v * v + z * z)) + productWithAngle(v, sqrt(u * u + z * z)) -
          z * z / 2 * log(u * u + v * v + z * z)) /
         twoPi();
}

Wide perpendicularTerm(const Wide& u, const Wide& y, const Wide& z) {
  const Wide squaredS = y * y + z * z, squared = u * u + squaredS;
  if (squared == 0) return 0;
  return (productWithAngle(u, sqrt(squaredS)) + (u * u - squaredS) / 4 * log(squared)) / twoPi();
}

/// The mixed difference of an antiderivative over two intervals.
template <typename Term>
Wide difference(const Interval& a, const Interval& b, const Term& term) {
  return term(Wide(a.high), Wide(b.high)) - term(Wide(a.high), Wide(b.low)) - term(Wide(a.low), Wide(b.high)) +
         term(Wide(a.low), Wide(b.low));
}

Wide areaOf(const AxisRectangle& rectangle) {
  assert(rectangle.first.low < rectangle.first.high && rectangle.second.low < rectangle.second.high);
  return (Wide(rectangle.first.high) - rectangle.first.low) * (Wide(rectangle.second.high) - rectangle.second.low);
}

}  // namespace

double parallelRectangles(const AxisRectangle& from, const AxisRectangle& to, double gap) {
  assert(gap > 0);
  const Wide sum = difference(from.first, to.first, [&](const Wide& x, const Wide& otherX) {
    return difference(from.second, to.second,
                      [&](const Wide& y, const Wide& otherY) { return parallelTerm(x - otherX, y - otherY, gap); });
  });
  return static_cast<double>(sum / areaOf(from));
}

double perpendicularRectangles(const AxisRectangle& from, const AxisRectangle& to) {
  assert(from.second.low >= 0 && to.second.low >= 0);
  const Wide sum = difference(from.first, to.first, [&](const Wide& x, const Wide& otherX) {
    return difference(from.second, to.second,
                      [&](const Wide& y, const Wide& z) { return perpendicularTerm(x - otherX, y, z); });
  });
  return static_cast<double>(sum / areaOf(from));
}

double elementToParallelRectangle(const AxisRectangle& to, double distance) {
  assert(distance > 0);
  const Wide z = distance;
  const Wide sum = difference(to.first, to.second, [&](const Wide& a, const Wide& b) {
    const Wide p = sqrt(a * a + z * z), q = sqrt(b * b + z * z);
    return Wide(a / p * atan(b / p) + b / q * atan(a / q));
  });
  return static_cast<double>(sum / twoPi());
}

double elementToPerpendicularRectangle(const AxisRectangle& to, double distance) {
  assert(distance > 0 && to.second.low >= 0);
  const Wide c = distance;
  const Wide sum = difference(to.first, to.second, [&](const Wide& b, const Wide& a) {
    const Wide p = sqrt(a * a + c * c);
    return Wide(-c / p * atan(b / p));
  });
  return static_cast<double>(sum / twoPi());
}

}  // namespace hemitex::tests
