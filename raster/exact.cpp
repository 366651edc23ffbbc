#include "raster/exact.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace hemitex::raster {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// Three binary64 numbers as integers times one power of two.
struct Scaled {
  std::array<Integer, 3> integers;
  int exponent = 0;
};

Scaled scale(const std::array<double, 3>& values) {
  constexpr int mantissaBits = 53;
  std::array<std::int64_t, 3> mantissas;
  std::array<int, 3> exponents;
  int lowest = 0;
  bool any = false;
  for (std::size_t k = 0; k < 3; ++k) {
    mantissas[k] = static_cast<std::int64_t>(std::ldexp(std::frexp(values[k], &exponents[k]), mantissaBits));
    exponents[k] -= mantissaBits;
    if (mantissas[k] != 0) lowest = any ? std::min(lowest, exponents[k]) : exponents[k];
    any |= mantissas[k] != 0;
  }
  Scaled scaled;
  scaled.exponent = lowest;
  for (std::size_t k = 0; k < 3; ++k)
    if (mantissas[k] != 0) scaled.integers[k] = Integer(mantissas[k]) << (exponents[k] - lowest);
  return scaled;
}

/// D of the file's head, in units of 2^(2 * w.exponent), summand by summand: e_k W_k.
std::array<Integer, 3> denominatorTerms(const ScreenTriangle& triangle, const Scaled& w, int column, int row) {
  std::array<Integer, 3> terms;
  for (std::size_t k = 0; k < 3; ++k)
    terms[k] = w.integers[(k + 1) % 3] * w.integers[(k + 2) % 3] * triangle.edges[k].at(column, row);
  return terms;
}

/// 1/w = numerator / denominator * 2^-exponent.
struct InverseDepth {
  Integer numerator, denominator;
  int exponent;
};

InverseDepth inverseDepth(const ScreenTriangle& triangle, int column, int row) {
  const Scaled w = scale(triangle.w);
  const std::array<Integer, 3> terms = denominatorTerms(triangle, w, column, row);
  return {terms[0] + terms[1] + terms[2], w.integers[0] * w.integers[1] * w.integers[2] * triangle.area, w.exponent};
}

Integer floorDivide(const Integer& numerator, const Integer& denominator) {
  Integer quotient, remainder;
  divide_qr(numerator, denominator, quotient, remainder);
  return remainder < 0 ? quotient - 1 : quotient;
}

}  // namespace

bool isNearerExactly(const ScreenTriangle& a, const ScreenTriangle& b, int column, int row) {
  const InverseDepth depthA = inverseDepth(a, column, row);
  const InverseDepth depthB = inverseDepth(b, column, row);
  Integer left = depthA.numerator * depthB.denominator;
  Integer right = depthB.numerator * depthA.denominator;
  if (depthA.exponent > depthB.exponent)
    right <<= depthA.exponent - depthB.exponent;
  else
    left <<= depthB.exponent - depthA.exponent;
  return left > right;
}

int texelExactly(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size, int column,
                 int row) {
  const Scaled w = scale(triangle.w);
  const Scaled t = scale(coordinate);
  const std::array<Integer, 3> terms = denominatorTerms(triangle, w, column, row);
  Integer denominator = terms[0] + terms[1] + terms[2];
  Integer numerator = (terms[0] * t.integers[0] + terms[1] * t.integers[1] + terms[2] * t.integers[2]) * size;
  if (t.exponent > 0)
    numerator <<= t.exponent;
  else
    denominator <<= -t.exponent;
  const Integer texel = floorDivide(numerator, denominator);
  return std::clamp(texel, Integer(0), Integer(size - 1)).convert_to<int>();
}

}  // namespace hemitex::raster
