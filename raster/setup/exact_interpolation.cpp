#include "raster/setup/exact_interpolation.h"

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstring>

namespace hemitex::raster {
namespace {

using BigInteger = boost::multiprecision::cpp_int;
__extension__ using Integer128 = __int128;

/// Three doubles as integers times one power of two, the largest common one. The integers are exact but may be large.
struct Scaled {
  std::array<double, 3> integers;
  int exponent = 0;
};

/// The exponent of the lowest bit of a normal double: its exponent minus 52. Values converted from binary32 are normal,
/// also after clipping.
int lowestBit(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<int>(bits >> 52 & 0x7ff) - 1075 + std::min(std::countr_zero(bits), 52);
}

/// 2^exponent, for -1022 to 1023.
double powerOfTwo(int exponent) {
  const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

Scaled scale(const std::array<double, 3>& values) {
  Scaled scaled{values, 0};
  bool any = false;
  for (const double value : values)
    if (value != 0) {
      const int bit = lowestBit(value);
      scaled.exponent = any ? std::min(scaled.exponent, bit) : bit;
      any = true;
    }
  for (double& value : scaled.integers) value *= powerOfTwo(-scaled.exponent);
  return scaled;
}

bool isConstant(const std::array<double, 3>& w) { return w[0] == w[1] && w[1] == w[2]; }

/// W_k of the formulas in exact_interpolation.h, in units of 2^(2 * w.exponent).
template <class Integer>
std::array<Integer, 3> otherDepths(const Scaled& w) {
  const auto w0 = static_cast<Integer>(w.integers[0]), w1 = static_cast<Integer>(w.integers[1]),
             w2 = static_cast<Integer>(w.integers[2]);
  return {w1 * w2, w2 * w0, w0 * w1};
}

/// The terms of the quotient: coordinate * size = 2^exponent sum(e_k t_k W_k) factor / sum(e_k W_k).
struct Coefficients {
  Scaled w, t;
  int factor, exponent;
};

Coefficients coefficientsOf(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size) {
  Coefficients result{isConstant(triangle.w) ? Scaled{{1, 1, 1}, 0} : scale(triangle.w), scale(coordinate), 0, 0};
  const int power = std::countr_zero(static_cast<unsigned>(size));
  result.factor = size >> power;
  result.exponent = result.t.exponent + power;
  return result;
}

template <class Integer>
Integer shifted(const Integer& value, int bits) {
  return value << bits;
}
double shifted(double value, int bits) { return value * powerOfTwo(bits); }

/// An upper bound of numerator and denominator at the samples of a triangle, except for rounding. May be infinite or
/// NaN.
double largestValue(const ScreenTriangle& triangle, const Coefficients& c) {
  const auto largest = [](const std::array<double, 3>& values) {
    return std::max({std::abs(values[0]), std::abs(values[1]), std::abs(values[2])});
  };
  const double depths = largest(otherDepths<double>(c.w)) * static_cast<double>(triangle.area);
  return std::max(shifted(depths * largest(c.t.integers) * c.factor, std::max(c.exponent, 0)),
                  shifted(depths, std::max(-c.exponent, 0)));
}

template <class Integer>
struct Quotient {
  std::array<Integer, 3> numerator, denominator;
};

template <class Integer>
Quotient<Integer> quotientOf(const Coefficients& c) {
  Quotient<Integer> result{{}, otherDepths<Integer>(c.w)};
  for (std::size_t k = 0; k < 3; ++k) {
    const Integer numerator = result.denominator[k] * static_cast<Integer>(c.t.integers[k]) * c.factor;
    result.numerator[k] = shifted(numerator, std::max(c.exponent, 0));
    result.denominator[k] = shifted(result.denominator[k], std::max(-c.exponent, 0));
  }
  return result;
}

template <class Integer>
int texelOf(const ScreenTriangle& triangle, const Coefficients& coefficients, int size, int column, int row) {
  const Quotient<Integer> quotient = quotientOf<Integer>(coefficients);
  Integer numerator = 0, denominator = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t edge = triangle.edges[k].at(column, row);
    numerator += quotient.numerator[k] * edge;
    denominator += quotient.denominator[k] * edge;
  }
  if (numerator < 0) return 0;
  const Integer texel = numerator / denominator;
  return texel < size ? static_cast<int>(texel) : size - 1;
}

/// The largest power of two that divides the values of all edges at all samples.
double unitOf(const ScreenTriangle& triangle) {
  std::int64_t bits = 0;
  for (const Edge& edge : triangle.edges) bits |= edge.a | edge.b | edge.c;
  return static_cast<double>(bits & -bits);
}

bool haveSameCorners(const ScreenTriangle& a, const ScreenTriangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    bool found = false;
    for (std::size_t m = 0; m < 3; ++m)
      found |= a.w[k] == b.w[m] && a.edges[k].a == b.edges[m].a && a.edges[k].b == b.edges[m].b &&
               a.edges[k].c == b.edges[m].c;
    if (!found) return false;
  }
  return true;
}

/// 1/w = numerator / denominator * 2^-exponent.
struct InverseDepth {
  BigInteger numerator, denominator;
  int exponent;
};

InverseDepth inverseDepth(const ScreenTriangle& triangle, int column, int row) {
  const Scaled w = scale(triangle.w);
  const std::array<BigInteger, 3> others = otherDepths<BigInteger>(w);
  BigInteger numerator = 0;
  for (std::size_t k = 0; k < 3; ++k) numerator += others[k] * triangle.edges[k].at(column, row);
  return {numerator, others[0] * BigInteger(w.integers[0]) * triangle.area, w.exponent};
}

}  // namespace

bool isNearerExactly(const ScreenTriangle& a, const ScreenTriangle& b, int column, int row) {
  if (isConstant(a.w) && isConstant(b.w)) return a.w[0] < b.w[0];
  if (haveSameCorners(a, b)) return false;
  const InverseDepth depthA = inverseDepth(a, column, row);
  const InverseDepth depthB = inverseDepth(b, column, row);
  BigInteger left = depthA.numerator * depthB.denominator;
  BigInteger right = depthB.numerator * depthA.denominator;
  if (depthA.exponent > depthB.exponent)
    right <<= depthA.exponent - depthB.exponent;
  else
    left <<= depthB.exponent - depthA.exponent;
  return left > right;
}

int texelExactly(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size, int column,
                 int row) {
  const Coefficients coefficients = coefficientsOf(triangle, coordinate, size);
  if (largestValue(triangle, coefficients) < 0x1p126)
    return texelOf<Integer128>(triangle, coefficients, size, column, row);
  return texelOf<BigInteger>(triangle, coefficients, size, column, row);
}

std::optional<ExactQuotient> exactQuotient(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate,
                                           int size) {
  const Coefficients coefficients = coefficientsOf(triangle, coordinate, size);
  // A quarter of 2^53 leaves room for the rounding of the bound and for the sum of two values.
  if (!(largestValue(triangle, coefficients) < 0x1p51 * unitOf(triangle))) return {};
  const auto [numerator, denominator] = quotientOf<double>(coefficients);
  return ExactQuotient{numerator, denominator};
}

}  // namespace hemitex::raster
