/// The depth buffer of a part of a face, and the lists of pixels whose depth or texel is not resolved in double
/// precision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/interface/face.h"
#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// Kernels process up to this number of pixels at a time, and may access as many pixels behind the end of a row.
inline constexpr int maxLanes = 16;

/// The nearest triangle and depth per pixel of a part of a face, row-major; noTriangle for the background.
struct DepthBuffer {
  Scissor scissor;        ///< the part of the face
  std::size_t pitch = 0;  ///< pixels from row to row: the width + maxLanes
  std::vector<double> inverseDepth;
  std::vector<std::uint32_t> triangle;
  std::vector<ItemId> id;  ///< of pixels that show a small triangle

  /// Sets the size and clears all pixels to the background; reuses the allocation.
  void clear(const Scissor& part);
  /// The index of the first pixel of a row of the face.
  std::size_t rowAt(int row) const { return static_cast<std::size_t>(row - scissor.row) * pitch; }
  std::size_t pixelAt(int column, int row) const {
    return rowAt(row) + static_cast<std::size_t>(column - scissor.column);
  }
};

inline constexpr std::uint32_t noTriangle = 0xffffffff;
/// From here on, numbers in the depth buffer are those of small triangles (small_triangles.h).
inline constexpr std::uint32_t firstSmall = 0x80000000;

inline bool isSmall(std::uint32_t number) { return number >= firstSmall && number != noTriangle; }

struct Pixel {
  int column, row;
};

/// Pixels that are not resolved in double precision.
struct UnresolvedPixels {
  std::vector<Pixel> pixels;

  void add(int column, int row);  // not inline, because kernels are compiled for other instruction sets than the rest
};

}  // namespace hemitex::raster
