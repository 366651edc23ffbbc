#include "raster/kernels/unresolved_samples.h"

#include <optional>

#include "raster/kernels/interpolation_bounds.h"

namespace hemitex::raster {
namespace {

bool isCovered(const ScreenTriangle& triangle, const EdgeValues& edge) {
  for (std::size_t k = 0; k < 3; ++k)
    if (edge[k] < minCovered(triangle)[k]) return false;
  return true;
}

double inverseDepthAt(const ScreenTriangle& triangle, const std::optional<DepthPlane>& plane, const EdgeValues& edge,
                      int column, int row) {
  return plane ? plane->inverseDepth(column, row) : raster::inverseDepthAt(triangle, edge);
}

}  // namespace

void listUnresolvedSamples(const ScreenTriangle& triangle, std::uint32_t number, const DepthBuffer& buffer,
                           UnresolvedPixels& unresolved) {
  const std::optional<DepthPlane> plane = depthPlane(triangle);
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const std::size_t pixel = buffer.pixelAt(column, row);
      const EdgeValues edge = edgeValues(triangle, column, row);
      if (buffer.triangle[pixel] == number || !isCovered(triangle, edge)) continue;
      const double inverseDepth = inverseDepthAt(triangle, plane, edge, column, row);
      if (isUnresolved(inverseDepth, buffer.inverseDepth[pixel])) unresolved.add(column, row);
    }
}

}  // namespace hemitex::raster
