#include "raster/pixel_kernels.h"

#include <cmath>

#include "raster/pixel_bounds.h"

namespace hemitex::raster {
namespace {

bool isCovered(const ScreenTriangle& triangle, const EdgeValues& edge) {
  for (std::size_t k = 0; k < 3; ++k)
    if (edge[k] < leastCovered(triangle)[k]) return false;
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
      const DepthTest test = testDepth(inverseDepth, number, buffer.pixelAt(column, row), buffer);
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

double texelOf(double position, const TexelPlane& plane) {
  return std::max(std::min(std::floor(position), plane.last), 0.0);
}

void findTexels(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base, std::uint32_t* texels,
                UndecidedPixels& undecided) {
  for (int i = 0; i < run.count; ++i) {
    const int pixelColumn = run.firstColumn + i;
    const double w = 1 / run.inverseDepth[i], clear = (0.5 - planes.rounding) - planes.error * w;
    const auto position = [&](const TexelPlane& plane) {
      return (plane.at + plane.down * run.row + plane.right * pixelColumn) * w;
    };
    const auto isClear = [clear](double at, const TexelPlane& plane) {
      return std::abs((at - std::floor(at)) - plane.middle) < clear;
    };
    const double across = position(planes.u), down = position(planes.v);
    if (isClear(across, planes.u) && isClear(down, planes.v))
      texels[i] =
          base + static_cast<std::uint32_t>(texelOf(down, planes.v) * (planes.u.last + 1) + texelOf(across, planes.u));
    else
      undecided.add(pixelColumn, run.row);
  }
}

void findExactTexels(const PixelRun& run, const ExactTexels& exact, int width, int height, std::uint32_t base,
                     std::uint32_t* texels) {
  const ExactLine u(run, exact.u), v(run, exact.v);
  const auto texel = [](const ExactLine& line, int i, int size) {
    return std::floor(
        std::max(std::min((line.at + line.step * i) / (line.below + line.belowStep * i), size - 1.0), 0.0));
  };
  for (int i = 0; i < run.count; ++i)
    texels[i] = base + static_cast<std::uint32_t>(texel(v, i, height) * width + texel(u, i, width));
}

/// A plane and how far off what comes of it may be, in texels over w.
struct BoundedPlane {
  TexelPlane plane;
  double error = 0;
};

/// A coordinate at a corner passes four roundings until it is a factor of the plane, the sums of the plane add three;
/// rows and columns multiplied and added up make at most five more. 16 units of what the terms may sum up to leave room
/// for the rounding of that sum. A single texel is everywhere.
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
  return result;
}

double largest(const std::array<double, 3>& values) {
  return std::max(std::max(std::abs(values[0]), std::abs(values[1])), std::abs(values[2]));
}

}  // namespace

void DepthBuffer::clear(const Scissor& part) {
  scissor = part;
  pitch = static_cast<std::size_t>(part.width + mostLanes);
  inverseDepth.assign(pitch * static_cast<std::size_t>(part.height), 0);
  triangle.assign(inverseDepth.size(), noTriangle);
}

/// 1/w has its own error, its inverse and the product round twice more.
TexelPlanes::TexelPlanes(const ScreenTriangle& triangle, int mapWidth, int mapHeight)
    : rounding(2 * depthError * std::max(largest(triangle.u) * mapWidth, largest(triangle.v) * mapHeight)) {
  const std::array<EdgePlane, 3> edges{EdgePlane(triangle, triangle.edges[0]), EdgePlane(triangle, triangle.edges[1]),
                                       EdgePlane(triangle, triangle.edges[2])};
  const BoundedPlane across = boundedPlane(triangle, edges, triangle.u, mapWidth);
  const BoundedPlane along = boundedPlane(triangle, edges, triangle.v, mapHeight);
  u = across.plane;
  v = along.plane;
  error = std::max(across.error, along.error);
}

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

void UndecidedPixels::add(int column, int row) { pixels.push_back({column, row}); }

const PixelKernels& plainKernels() {
  static const PixelKernels kernels{"plain", offer, isHidden, endOfRun, findTexels, findExactTexels};
  return kernels;
}

const PixelKernels& bestKernels() { return simdKernels().empty() ? plainKernels() : simdKernels().front(); }

}  // namespace hemitex::raster
