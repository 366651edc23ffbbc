#include "raster/kernels/small_triangle_kernels.h"

#include <algorithm>
#include <cmath>

#include "raster/kernels/interpolation_bounds.h"

namespace hemitex::raster {
namespace {

/// One value per corner of a triangle.
template <typename Value>
using Corners = std::array<Value, 3>;

PixelRange samplesIn(const Corners<std::int32_t>& values, int first, int count) {
  return samplesBetween(values[0], values[1], values[2], first, first + count);
}

/// Positions of corners relative to the sample of a pixel.
Corners<std::int32_t> fromSample(const Corners<std::int32_t>& snapped, int pixel) {
  const std::int32_t sample = 256 * pixel + 128;
  return {snapped[0] - sample, snapped[1] - sample, snapped[2] - sample};
}

/// The value at the origin of the edge from corner p to corner q. It is positive inside if the area of the triangle is
/// positive.
std::int32_t edgeAt(const Corners<std::int32_t>& x, const Corners<std::int32_t>& y, std::size_t p, std::size_t q) {
  return x[p] * y[q] - x[q] * y[p];
}

/// Whether an edge of a triangle of positive area is a left or a top edge, whose samples are covered.
bool isInclusive(const Corners<std::int32_t>& x, const Corners<std::int32_t>& y, std::size_t p, std::size_t q) {
  return y[p] > y[q] || (y[p] == y[q] && x[q] > x[p]);
}

/// Whether a triangle of either orientation covers the origin.
bool coversOrigin(const Corners<std::int32_t>& x, const Corners<std::int32_t>& y) {
  const bool isPositive = edgeAt(x, y, 0, 1) + edgeAt(x, y, 1, 2) + edgeAt(x, y, 2, 0) > 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t p = isPositive ? k : (k + 1) % 3, q = isPositive ? (k + 1) % 3 : k;
    if (edgeAt(x, y, p, q) < (isInclusive(x, y, p, q) ? 0 : 1)) return false;
  }
  return true;
}

/// A texture coordinate in texels, from the weights of the corners and the inverse of their sum. The three weights have
/// the same sign. There are eleven roundings, far below depthError, which the bound includes.
struct SmallTexel {
  double texel;
  bool isClear;

  SmallTexel(const Corners<double>& weights, double inverseSum, const Corners<double>& coordinate, int texels) {
    const double size = texels;
    const double sum = (weights[0] * coordinate[0] + weights[1] * coordinate[1]) + weights[2] * coordinate[2];
    const double position = sum * inverseSum * size;
    const double largest =
        std::max(std::max(std::abs(coordinate[0]), std::abs(coordinate[1])), std::abs(coordinate[2])) * size;
    const double whole = std::floor(position);
    isClear = std::abs((position - whole) - 0.5) < 0.5 - depthError * largest || size == 1;
    texel = std::max(std::min(whole, size - 1), 0.0);
  }
};

/// Finds the samples of the `t`th triangle of a part.
void findSamples(const SmallTriangles& triangles, std::uint32_t t, const Scissor& scissor, SmallSamples& samples) {
  Corners<std::int32_t> across, down;
  Corners<double> w, u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t corner = triangles.mesh.corners[k][triangles.part.firstTriangle + t];
    const glm::vec2& texcoord = triangles.mesh.texcoords[triangles.part.firstVertex + corner];
    across[k] = triangles.placed.across[corner];
    down[k] = triangles.placed.down[corner];
    w[k] = triangles.placed.w[corner];
    u[k] = texcoord.x;
    v[k] = texcoord.y;
  }
  const PixelRange columns = samplesIn(across, scissor.column, scissor.width);
  const PixelRange rows = samplesIn(down, scissor.row, scissor.height);
  for (int row = rows.first; row < rows.end; ++row)
    for (int column = columns.first; column < columns.end; ++column) {
      const Corners<std::int32_t> x = fromSample(across, column), y = fromSample(down, row);
      const Corners<double> edges{static_cast<double>(edgeAt(x, y, 1, 2)), static_cast<double>(edgeAt(x, y, 2, 0)),
                                  static_cast<double>(edgeAt(x, y, 0, 1))};
      const double area = edges[0] + edges[1] + edges[2];
      if (area == 0 || !coversOrigin(x, y)) continue;
      const Corners<double> weights{edges[0] * (w[1] * w[2]), edges[1] * (w[2] * w[0]), edges[2] * (w[0] * w[1])};
      const double sum = (weights[0] + weights[1]) + weights[2], inverseSum = 1 / sum;
      const SmallTexel texelColumn(weights, inverseSum, u, triangles.columns);
      const SmallTexel texelRow(weights, inverseSum, v, triangles.rows);
      const std::size_t i = samples.count++;
      samples.triangles[i] = static_cast<std::int32_t>(t);
      samples.columns[i] = column;
      samples.rows[i] = row;
      // 1/w is the sum of e_k / w_k over the area; all terms have the same sign, and each has at most eight roundings.
      samples.inverseDepths[i] = sum / (((w[0] * w[1]) * w[2]) * area);
      samples.texels[i] = texelColumn.isClear && texelRow.isClear
                              ? static_cast<std::int32_t>(texelRow.texel * triangles.columns + texelColumn.texel)
                              : undecidedTexel;
      if (area < 0) samples.negative |= 1U << t;
    }
}

void findSamples(const SmallTriangles& triangles, const Scissor& part, SmallSamples& samples) {
  samples.count = 0;
  samples.negative = 0;
  for (std::uint32_t t = 0; t < triangles.part.triangles; ++t)
    if ((triangles.set >> t & 1) != 0) findSamples(triangles, t, part, samples);
}

}  // namespace

template <>
const SmallTriangleKernels& scalarKernels<SmallTriangleKernels>() {
  static const SmallTriangleKernels kernels{"scalar", findSamples};
  return kernels;
}

}  // namespace hemitex::raster
