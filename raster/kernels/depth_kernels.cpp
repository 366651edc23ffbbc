#include "raster/kernels/depth_kernels.h"

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

bool offer(const ScreenTriangle& triangle, std::uint32_t number, DepthBuffer& buffer, UndecidedPixels& undecided) {
  const std::optional<DepthPlane> plane = depthPlane(triangle);
  bool taken = false;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const EdgeValues edge = edgeValues(triangle, column, row);
      if (!isCovered(triangle, edge)) continue;
      const double inverseDepth = inverseDepthAt(triangle, plane, edge, column, row);
      const DepthTest test = offerDepth(inverseDepth, number, buffer.pixelAt(column, row), buffer);
      if (test == DepthTest::Undecided) undecided.add(column, row);
      taken = taken || test == DepthTest::Taken;
    }
  return taken;
}

bool isHidden(const DepthBuffer& buffer, const Scissor& part, double inverseDepth) {
  for (int row = part.row; row < part.row + part.height; ++row) {
    const double* const depths = buffer.inverseDepth.data() + buffer.rowAt(row) + (part.column - buffer.scissor.column);
    for (int i = 0; i < part.width; ++i)
      if (depths[i] <= inverseDepth) return false;
  }
  return true;
}

int endOfRun(const std::uint32_t* triangles, int first, int end) {
  int i = first;
  while (i < end && triangles[i] == triangles[first]) ++i;
  return i;
}

int endOfSmall(const std::uint32_t* triangles, int first, int end) {
  while (first < end && isSmall(triangles[first])) ++first;
  return first;
}

}  // namespace

void listUndecidedSamples(const ScreenTriangle& triangle, std::uint32_t number, const DepthBuffer& buffer,
                          UndecidedPixels& undecided) {
  const std::optional<DepthPlane> plane = depthPlane(triangle);
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const std::size_t pixel = buffer.pixelAt(column, row);
      const EdgeValues edge = edgeValues(triangle, column, row);
      if (buffer.triangle[pixel] == number || !isCovered(triangle, edge)) continue;
      const double inverseDepth = inverseDepthAt(triangle, plane, edge, column, row);
      if (compareDepths(inverseDepth, buffer.inverseDepth[pixel]) == DepthTest::Undecided) undecided.add(column, row);
    }
}

template <>
const DepthKernels& scalarKernels<DepthKernels>() {
  static const DepthKernels kernels{"scalar", offer, isHidden, endOfRun, endOfSmall};
  return kernels;
}

}  // namespace hemitex::raster
