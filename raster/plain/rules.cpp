#include "raster/plain/rules.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace hemitex::raster {

using Rational = boost::multiprecision::cpp_rational;

namespace {

/// A number of at least 0 as a whole number: the nearest one, of two the even one.
Rational roundedToEven(const Rational& value) {
  const boost::multiprecision::cpp_int whole = numerator(value) / denominator(value);
  const Rational beyond = value - Rational(whole) - Rational(1, 2);
  return Rational(beyond > 0 || (beyond == 0 && whole % 2 == 1) ? whole + 1 : whole);
}

/// The distance of binary32 numbers around a number from 0 to 1.
Rational spacingAt(const Rational& value) {
  Rational unit(1, boost::multiprecision::cpp_int(1) << 149);
  while (value >= unit * (1 << 24)) unit *= 2;
  return unit;
}

Rational exactDepth(const CoveredSample& sample) {
  return depthOf(*sample.triangle, weightsOverDepth<Rational>(*sample.triangle, sample.weights));
}

}  // namespace

double storedDepthExactly(const SnappedTriangle& triangle, const Weights& weights) {
  const DepthRule& rule = triangle.depthRule;
  const Rational free =
      Rational(rule.scale) * depthOf(triangle, weightsOverDepth<Rational>(triangle, weights)) + Rational(rule.offset);
  const Rational depth = free < 0 ? Rational(0) : free > 1 ? Rational(1) : free;
  if (rule.precision == DepthPrecision::Float32) {
    const Rational unit = spacingAt(depth);
    return static_cast<Rational>(roundedToEven(depth / unit) * unit).convert_to<double>();
  }
  const double steps = rule.precision == DepthPrecision::Unorm16 ? 0xffff : 0xffffff;
  return roundedToEven(depth * Rational(steps)).convert_to<double>() / steps;
}

bool isNearerExactly(const CoveredSample& a, const CoveredSample& b) { return exactDepth(a) < exactDepth(b); }

int texelExactly(const CoveredSample& sample, double ViewVertex::*coordinate, int size) {
  const auto overDepth = weightsOverDepth<Rational>(*sample.triangle, sample.weights);
  const Rational place = interpolated(*sample.triangle, overDepth, coordinate) * size;
  if (place < 0 || place >= size) return place < 0 ? 0 : size - 1;
  return static_cast<int>(numerator(place) / denominator(place));
}

}  // namespace hemitex::raster
