/// Edge values at samples and error bounds of double precision, shared by the kernels of depths, texels and small
/// triangles.
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

/// The values of the three edges at a sample. They are integers below 2^49, so that doubles represent and compute them
/// exactly.
using EdgeValues = std::array<double, 3>;

inline EdgeValues edgeValues(const ScreenTriangle& triangle, int column, int row) {
  EdgeValues values;
  for (std::size_t k = 0; k < 3; ++k) values[k] = static_cast<double>(triangle.edges[k].at(column, row));
  return values;
}

/// The change of the edge values from column to column.
inline EdgeValues edgeSteps(const ScreenTriangle& triangle) {
  EdgeValues steps;
  for (std::size_t k = 0; k < 3; ++k) steps[k] = static_cast<double>(triangle.edges[k].a);
  return steps;
}

/// The change of the edge values from row to row.
inline EdgeValues edgeRowSteps(const ScreenTriangle& triangle) {
  EdgeValues steps;
  for (std::size_t k = 0; k < 3; ++k) steps[k] = static_cast<double>(triangle.edges[k].b);
  return steps;
}

/// The smallest edge values at covered samples, which are integers: 0 on an inclusive edge, else 1.
inline EdgeValues minCovered(const ScreenTriangle& triangle) {
  EdgeValues least;
  for (std::size_t k = 0; k < 3; ++k) least[k] = static_cast<double>(triangle.edges[k].minCovered());
  return least;
}

/// 1/w at a sample is the sum of edge value times triangle.inverseDepth, added in the order of the vertices. All terms
/// are positive and each has at most five roundings. So the relative error is below 6 units of roundoff.
inline double inverseDepthAt(const ScreenTriangle& triangle, const EdgeValues& edge) {
  return edge[0] * triangle.inverseDepth[0] + edge[1] * triangle.inverseDepth[1] + edge[2] * triangle.inverseDepth[2];
}

/// The same sum as a plane: (at + down * row) + right * column. It is cheaper but less accurate, because terms cancel.
struct DepthPlane {
  double at = 0, down = 0, right = 0;

  double inverseDepth(int column, int row) const { return (at + down * row) + right * column; }
};

/// Upper bound of the relative error of 1/w, however it is computed. Two values are in order if they differ by more
/// than depthMargin times one of them.
inline constexpr double depthError = 0x1p-40;
inline constexpr double depthMargin = 4 * depthError;

/// Whether double precision does not tell which of two samples of a pixel is nearer; arguments are values of 1/w.
inline bool isUnresolved(double inverseDepth, double stored) {
  return std::abs(inverseDepth - stored) <= depthMargin * inverseDepth;
}

/// The value of an edge as at + down * row + right * column. `most` bounds the sum of the absolute terms within the
/// rows and columns of the triangle.
struct EdgePlane {
  double at, down, right, most;

  EdgePlane(const ScreenTriangle& triangle, const Edge& edge)
      : at(static_cast<double>(edge.c)),
        down(static_cast<double>(edge.b)),
        right(static_cast<double>(edge.a)),
        most(std::abs(at) + std::abs(down) * triangle.endRow + std::abs(right) * triangle.endColumn) {}
};

/// The plane of a triangle, if the triangle is wider than a vector and the plane is accurate enough. Each term has at
/// most twelve roundings. The error bound is 16 units of roundoff of the sum of the absolute terms, over the smallest
/// 1/w.
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
