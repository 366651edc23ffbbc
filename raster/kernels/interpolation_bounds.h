/// What the kernels of depths, texels and small triangles have in common: the values of a triangle's edges at samples,
/// and how far off binary64 may be in what is computed from them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "raster/kernels/depth_buffer.h"
#include "raster/setup/triangle_setup.h"

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

/// What they change by from column to column.
inline EdgeValues edgeSteps(const ScreenTriangle& triangle) {
  EdgeValues steps;
  for (std::size_t k = 0; k < 3; ++k) steps[k] = static_cast<double>(triangle.edges[k].a);
  return steps;
}

/// What they change by from row to row.
inline EdgeValues edgeRowSteps(const ScreenTriangle& triangle) {
  EdgeValues steps;
  for (std::size_t k = 0; k < 3; ++k) steps[k] = static_cast<double>(triangle.edges[k].b);
  return steps;
}

/// The least values at samples that are covered: values are integers.
inline EdgeValues minCovered(const ScreenTriangle& triangle) {
  EdgeValues least;
  for (std::size_t k = 0; k < 3; ++k) least[k] = triangle.edges[k].inclusive ? 0 : 1;
  return least;
}

/// 1/w at a sample is the sum of edge times triangle.inverseDepth, added in the order of the vertices. All terms are
/// positive and each passes at most five roundings, so its relative error is below 6 units of roundoff.
inline double inverseDepthAt(const ScreenTriangle& triangle, const EdgeValues& edge) {
  return edge[0] * triangle.inverseDepth[0] + edge[1] * triangle.inverseDepth[1] + edge[2] * triangle.inverseDepth[2];
}

/// The same sum as (at + down * row) + right * column: less to compute, and farther off, since its terms cancel.
struct DepthPlane {
  double at = 0, down = 0, right = 0;

  double inverseDepth(int column, int row) const { return (at + down * row) + right * column; }
};

/// What 1/w may be off at most, relative to it, however it is computed; two values are in order when they differ by
/// four times as much of the one.
inline constexpr double depthError = 0x1p-40;
inline constexpr double depthMargin = 4 * depthError;

/// What the test of a sample against a depth buffer says.
enum class DepthTest { Hidden, Taken, Undecided };

/// Whether a sample with 1/w = `offered` is in front of one that is `stored`.
inline DepthTest compareDepths(double offered, double stored) {
  const double difference = offered - stored;
  if (std::abs(difference) <= depthMargin * offered) return DepthTest::Undecided;
  return difference < 0 ? DepthTest::Hidden : DepthTest::Taken;
}

/// Offers 1/w of a triangle to a pixel of a buffer, by its place there, which stores it where it wins.
inline DepthTest offerDepth(double inverseDepth, std::uint32_t number, std::size_t pixel, DepthBuffer& buffer) {
  const DepthTest test = compareDepths(inverseDepth, buffer.inverseDepth[pixel]);
  if (test != DepthTest::Taken) return test;
  buffer.inverseDepth[pixel] = inverseDepth;
  buffer.triangle[pixel] = number;
  return test;
}

/// The value of an edge as at + down * row + right * column, and what these may sum up to in the triangle's rows and
/// columns, whatever their signs.
struct EdgePlane {
  double at, down, right, most;

  EdgePlane(const ScreenTriangle& triangle, const Edge& edge)
      : at(static_cast<double>(edge.c)),
        down(static_cast<double>(edge.b)),
        right(static_cast<double>(edge.a)),
        most(std::abs(at) + std::abs(down) * triangle.endRow + std::abs(right) * triangle.endColumn) {}
};

/// The plane of a triangle where it pays, in triangles wider than a vector, and where it is good enough. Each term
/// passes twelve roundings at most; 16 units of what the terms may sum up to, over the smallest 1/w, bound its error.
inline std::optional<DepthPlane> depthPlane(const ScreenTriangle& triangle) {
  if (triangle.endColumn - triangle.firstColumn <= maxLanes) return {};
  DepthPlane plane;
  double terms = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgePlane edge(triangle, triangle.edges[k]);
    plane.at += edge.at * triangle.inverseDepth[k];
    plane.down += edge.down * triangle.inverseDepth[k];
    plane.right += edge.right * triangle.inverseDepth[k];
    terms += edge.most * triangle.inverseDepth[k];
  }
  const double farthest = std::max({triangle.w[0], triangle.w[1], triangle.w[2]});
  if (!(16 * unitRoundoff * terms * farthest < depthError)) return {};
  return plane;
}

}  // namespace hemitex::raster
