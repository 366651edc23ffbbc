#include "raster/small_triangle_kernels.h"

#include <algorithm>
#include <cmath>

#include "raster/pixel_bounds.h"

namespace hemitex::raster {
namespace {

struct Range {
  int first, end;
};

/// Pixels of [first, first + count) whose samples lie between the least and the largest of three snapped values.
Range samplesIn(const std::array<std::int32_t, 3>& values, int first, int count) {
  const auto [least, largest] = std::minmax({values[0], values[1], values[2]});
  return {std::max((least + 127) >> 8, first), std::min((largest + 128) >> 8, first + count)};
}

/// An edge as the line c + a * i + b * j through the samples i columns and j rows away.
struct SmallEdge {
  float a, b, c;
  float least;  ///< value of samples that are covered; see Edge::inclusive

  SmallEdge(float px, float py, float qx, float qy, float orientation)
      : a(256 * orientation * (py - qy)),
        b(256 * orientation * (qx - px)),
        c(orientation * (px * qy - qx * py)),
        least(a > 0 || (a == 0 && b > 0) ? 0.0F : 1.0F) {}

  float at(int i, int j) const { return c + a * static_cast<float>(i) + b * static_cast<float>(j); }
};

/// The `t`th triangle of a part.
bool offerOne(const OfferedTriangles& triangles, std::uint32_t t, DepthBuffer& buffer, UndecidedSamples& undecided) {
  std::array<std::int32_t, 3> across, down;
  std::array<double, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t corner = triangles.mesh.corners[k][triangles.part.firstTriangle + t];
    across[k] = triangles.placed.across[corner];
    down[k] = triangles.placed.down[corner];
    w[k] = triangles.placed.w[corner];
  }
  const Range columns = samplesIn(across, buffer.scissor.column, buffer.scissor.width);
  const Range rows = samplesIn(down, buffer.scissor.row, buffer.scissor.height);
  std::array<float, 3> x, y;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = static_cast<float>(across[k] - (256 * columns.first + 128));
    y[k] = static_cast<float>(down[k] - (256 * rows.first + 128));
  }
  const float area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  if (area == 0) return false;
  const float orientation = area > 0 ? 1 : -1;
  const std::array<SmallEdge, 3> edges{SmallEdge{x[1], y[1], x[2], y[2], orientation},
                                       SmallEdge{x[2], y[2], x[0], y[0], orientation},
                                       SmallEdge{x[0], y[0], x[1], y[1], orientation}};
  // 1 / (w_k area) by one division; each term of a sum below passes seven roundings at most, see inverseDepthAt.
  const double scale = 1 / (w[0] * w[1] * w[2] * static_cast<double>(std::abs(area)));
  const std::array<double, 3> weights{w[1] * w[2] * scale, w[2] * w[0] * scale, w[0] * w[1] * scale};
  bool isTaken = false;
  for (int row = rows.first; row < rows.end; ++row)
    for (int column = columns.first; column < columns.end; ++column) {
      std::array<float, 3> e;
      for (std::size_t k = 0; k < 3; ++k) e[k] = edges[k].at(column - columns.first, row - rows.first);
      if (e[0] < edges[0].least || e[1] < edges[1].least || e[2] < edges[2].least) continue;
      const double inverseDepth = (static_cast<double>(e[0]) * weights[0] + static_cast<double>(e[1]) * weights[1]) +
                                  static_cast<double>(e[2]) * weights[2];
      const std::uint32_t number = triangles.firstNumber + t;
      const DepthTest test = testDepth(inverseDepth, number, buffer.pixelAt(column, row), buffer);
      isTaken = isTaken || test == DepthTest::Taken;
      if (test == DepthTest::Undecided) undecided.add(number, column, row);
    }
  return isTaken;
}

bool offer(const OfferedTriangles& triangles, DepthBuffer& buffer, UndecidedSamples& undecided) {
  bool isTaken = false;
  for (std::uint32_t t = 0; t < triangles.part.triangles; ++t)
    if ((triangles.set >> t & 1) != 0) isTaken = offerOne(triangles, t, buffer, undecided) || isTaken;
  return isTaken;
}

/// A texture coordinate in texels, from the weights of the corners and the inverse of their sum. Weights are positive
/// or negative all three, and eleven roundings on the way are far below depthError, which the bound has room for.
struct SmallTexel {
  double texel;
  bool isClear;

  SmallTexel(const std::array<double, 3>& weights, double inverseSum, const std::array<double, 3>& coordinate,
             double size) {
    const double sum = (weights[0] * coordinate[0] + weights[1] * coordinate[1]) + weights[2] * coordinate[2];
    const double position = sum * inverseSum * size;
    const double largest =
        std::max(std::max(std::abs(coordinate[0]), std::abs(coordinate[1])), std::abs(coordinate[2])) * size;
    const double whole = std::floor(position);
    isClear = std::abs((position - whole) - 0.5) < 0.5 - depthError * largest || size == 1;
    texel = std::max(std::min(whole, size - 1), 0.0);
  }
};

SmallTexels findTexels(const SmallPixels& pixels, std::size_t count) {
  SmallTexels found;
  for (std::size_t i = 0; i < count; ++i) {
    const auto corners = [i](const std::array<SmallPixels::Values, 3>& values) {
      return std::array<double, 3>{values[0][i], values[1][i], values[2][i]};
    };
    const std::array<double, 3> x = corners(pixels.across), y = corners(pixels.down), w = corners(pixels.w);
    const std::array<double, 3> weights{(x[1] * y[2] - x[2] * y[1]) * (w[1] * w[2]),
                                        (x[2] * y[0] - x[0] * y[2]) * (w[2] * w[0]),
                                        (x[0] * y[1] - x[1] * y[0]) * (w[0] * w[1])};
    const double sum = (weights[0] + weights[1]) + weights[2], inverseSum = 1 / sum;
    const SmallTexel column(weights, inverseSum, corners(pixels.u), pixels.columns[i]);
    const SmallTexel row(weights, inverseSum, corners(pixels.v), pixels.rows[i]);
    found.texels[i] = static_cast<std::uint32_t>(row.texel * pixels.columns[i] + column.texel);
    if (column.isClear && row.isClear) found.decided |= 1U << i;
    if (sum < 0) found.negative |= 1U << i;
  }
  return found;
}

}  // namespace

void UndecidedSamples::add(std::uint32_t number, int column, int row) { samples.push_back({number, {column, row}}); }

const SmallTriangleKernels& plainSmallTriangleKernels() {
  static const SmallTriangleKernels kernels{"plain", offer, findTexels};
  return kernels;
}

const SmallTriangleKernels& bestSmallTriangleKernels() {
  return simdSmallTriangleKernels().empty() ? plainSmallTriangleKernels() : simdSmallTriangleKernels().front();
}

}  // namespace hemitex::raster
