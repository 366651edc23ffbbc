#include "raster/plain/rules.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace hemitex::raster {

using Rational = boost::multiprecision::cpp_rational;

bool isNearerExactly(const CoveredSample& a, const CoveredSample& b) {
  return inverseDepth(weightsOverDepth<Rational>(*a.triangle, a.weights)) >
         inverseDepth(weightsOverDepth<Rational>(*b.triangle, b.weights));
}

int texelExactly(const CoveredSample& sample, double ViewVertex::*coordinate, int size) {
  const auto overDepth = weightsOverDepth<Rational>(*sample.triangle, sample.weights);
  const Rational place = interpolated(*sample.triangle, overDepth, coordinate) * size;
  if (place < 0 || place >= size) return place < 0 ? 0 : size - 1;
  return static_cast<int>(numerator(place) / denominator(place));
}

}  // namespace hemitex::raster
