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

bool offer(const ScreenTriangle& triangle, std::uint32_t number, DepthBuffer& buffer, UndecidedPixels& undecided) {
  bool taken = false;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row) {
    const std::size_t begin = buffer.rowAt(row) - static_cast<std::size_t>(buffer.scissor.column);
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const EdgeValues edge = edgeValues(triangle, column, row);
      if (!isCovered(triangle, edge)) continue;
      const std::size_t pixel = begin + static_cast<std::size_t>(column);
      const double inverseDepth = inverseDepthAt(triangle, edge);
      const double difference = inverseDepth - buffer.inverseDepth[pixel];
      if (std::abs(difference) <= depthMargin * inverseDepth) {
        undecided.add(column, row);
      } else if (difference > 0) {
        buffer.inverseDepth[pixel] = inverseDepth;
        buffer.triangle[pixel] = number;
        taken = true;
      }
    }
  }
  return taken;
}

/// The border between texels that is nearest to a position, as the number of the texel behind it.
double nearestBorder(double position, int size) {
  return std::nearbyint(std::max(std::min(position, size - 1.0), 1.0));
}

int endOfRun(const std::uint32_t* triangles, int first, int end) {
  int i = first;
  while (i < end && triangles[i] == triangles[first]) ++i;
  return i;
}

void findTexels(const PixelRun& run, int width, int height, std::uint32_t base, std::uint32_t* texels,
                UndecidedPixels& undecided) {
  const RunLines lines(run, width, height);
  for (int i = 0; i < run.count; ++i) {
    const double w = 1 / run.inverseDepth[i];
    const double across = (lines.u.at + lines.u.step * i) * w, down = (lines.v.at + lines.v.step * i) * w;
    const double column = nearestBorder(across, width), row = nearestBorder(down, height);
    if (std::abs(across - column) > lines.u.error && std::abs(down - row) > lines.v.error)
      texels[i] = base + static_cast<std::uint32_t>((row - (down < row)) * width + (column - (across < column)));
    else
      undecided.add(run.firstColumn + i, run.row);
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

}  // namespace

DepthBuffer::DepthBuffer(const Scissor& part)
    : scissor(part),
      pitch(static_cast<std::size_t>(part.width + mostLanes)),
      inverseDepth(pitch * static_cast<std::size_t>(part.height)),
      triangle(inverseDepth.size(), noTriangle) {}

void UndecidedPixels::add(int column, int row) { pixels.push_back({column, row}); }

const PixelKernels& plainKernels() {
  static const PixelKernels kernels{"plain", offer, endOfRun, findTexels, findExactTexels};
  return kernels;
}

const PixelKernels& bestKernels() { return simdKernels().empty() ? plainKernels() : simdKernels().front(); }

}  // namespace hemitex::raster
