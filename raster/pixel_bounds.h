/// What all pixel kernels have in common: the values of a triangle's edges at samples, and how far off binary64 may be
/// in what is computed from them.
#pragma once

#include <array>
#include <cstddef>

#include "raster/screen_triangle.h"

namespace hemitex::raster {

inline constexpr double unitRoundoff = 0x1p-53;

/// The values of the three edges at a sample. They are integers below 2^49, so binary64 holds them, and computes them,
/// without rounding.
using EdgeValues = std::array<double, 3>;

inline EdgeValues edgeValues(const ScreenTriangle& triangle, int column, int row) {
  EdgeValues values;
  for (std::size_t k = 0; k < 3; ++k) values[k] = static_cast<double>(triangle.edges[k].at(column, row));
  return values;
}

/// The least value of an edge at samples that it covers: values are integers.
inline double leastCovered(const Edge& edge) { return edge.inclusive ? 0 : 1; }

/// 1/w at a sample is the sum of edge times triangle.inverseDepth, added in the order of the vertices. All terms are
/// positive and each passes at most five roundings, so its relative error is below 6 units of roundoff; two such values
/// are in order when they differ by 16 of the one.
inline constexpr double depthMargin = 16 * unitRoundoff;

inline double inverseDepthAt(const ScreenTriangle& triangle, const EdgeValues& edge) {
  return edge[0] * triangle.inverseDepth[0] + edge[1] * triangle.inverseDepth[1] + edge[2] * triangle.inverseDepth[2];
}

/// A texture coordinate in texels, along a row of a triangle: position = sum(edge * overDepth) * (1 / (1/w)).
struct TexelTerms {
  std::array<double, 3> overDepth = {};
  double error = 0;  ///< of the position, at most
};

/// Seven roundings in each term of the sum, whose size is at most largest * size / w, six in 1/w, and two in what
/// follows: 16 units leave room. A single texel is everywhere.
inline TexelTerms termsOf(const ScreenTriangle& triangle, const Coordinate& coordinate, int size) {
  if (size == 1) return {};
  TexelTerms terms{{}, 16 * unitRoundoff * coordinate.largest * size};
  for (std::size_t k = 0; k < 3; ++k) terms.overDepth[k] = coordinate.at[k] * triangle.inverseDepth[k] * size;
  return terms;
}

}  // namespace hemitex::raster
