#include "raster/kernels/texel_planes.h"

#include <algorithm>
#include <cmath>

#include "raster/kernels/interpolation_bounds.h"

namespace hemitex::raster {
namespace {

/// A plane with its error bounds: `error` is the error of the plane, in texels over w; `rounding` is the error of 1/w
/// and of the product, in texels.
struct BoundedPlane {
  TexelPlane plane;
  double error = 0, rounding = 0;
};

double largest(const std::array<double, 3>& values) {
  return std::max(std::max(std::abs(values[0]), std::abs(values[1])), std::abs(values[2]));
}

/// A coordinate at a corner has four roundings until it is a factor of the plane. The sums of the plane add three;
/// evaluating it at a row and a column adds at most five. 16 units of roundoff of the sum of the absolute terms leave
/// room for the rounding of that sum. 1/w has its own error; its inverse and the product add two roundings. With a
/// single texel the result is always 0.
BoundedPlane boundedPlane(const ScreenTriangle& triangle, const std::array<EdgePlane, 3>& edges,
                          const std::array<double, 3>& coordinate, int size) {
  BoundedPlane result;
  if (size == 1) return result;
  result.plane.last = size - 1;
  result.plane.middle = 0.5;
  for (std::size_t k = 0; k < 3; ++k) {
    const double overDepth = coordinate[k] * triangle.inverseDepth[k] * size;
    result.plane.at += edges[k].at * overDepth;
    result.plane.down += edges[k].down * overDepth;
    result.plane.right += edges[k].right * overDepth;
    result.error += edges[k].most * std::abs(overDepth);
  }
  result.error *= 16 * unitRoundoff;
  result.rounding = 2 * depthError * largest(coordinate) * size;
  return result;
}

}  // namespace

TexelPlanes::TexelPlanes(const ScreenTriangle& triangle, int mapWidth, int mapHeight) {
  const std::array<EdgePlane, 3> edges{EdgePlane(triangle, triangle.edges[0]), EdgePlane(triangle, triangle.edges[1]),
                                       EdgePlane(triangle, triangle.edges[2])};
  const BoundedPlane across = boundedPlane(triangle, edges, triangle.u, mapWidth);
  const BoundedPlane along = boundedPlane(triangle, edges, triangle.v, mapHeight);
  u = across.plane;
  v = along.plane;
  error = std::max(across.error, along.error);
  rounding = std::max(across.rounding, along.rounding);
}

}  // namespace hemitex::raster
