/// The depth buffer of a part of a face, and lists of pixels whose depth or texel binary64 does not decide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/interface/face.h"

namespace hemitex::raster {

/// Kernels work on up to so many pixels at a time, and may touch as many behind the end of a row.
inline constexpr int maxLanes = 16;

/// What the pixels of a part of a face show so far, row-major; no triangle where the background is.
struct DepthBuffer {
  Scissor scissor;        ///< the part
  std::size_t pitch = 0;  ///< pixels from row to row: the width and maxLanes
  std::vector<double> inverseDepth;
  std::vector<std::uint32_t> triangle;

  /// The background of a part, in the memory that is there.
  void clear(const Scissor& part);
  /// Where the pixels of a row of the face begin.
  std::size_t rowAt(int row) const { return static_cast<std::size_t>(row - scissor.row) * pitch; }
  std::size_t pixelAt(int column, int row) const {
    return rowAt(row) + static_cast<std::size_t>(column - scissor.column);
  }
};

inline constexpr std::uint32_t noTriangle = 0xffffffff;

struct Pixel {
  int column, row;
};

/// Pixels that binary64 leaves undecided.
struct UndecidedPixels {
  std::vector<Pixel> pixels;

  void add(int column, int row);  // not inline: kernels are compiled for other instruction sets than the rest
};

}  // namespace hemitex::raster
