/// Pixel kernels: the two loops over pixels in which drawing spends its time, the depth test of a triangle's samples
/// and the texels of a run of pixels. There is a plain version, which says what they compute, and one for each SIMD
/// instruction set that the processor has; all give the same numbers, bit for bit.
///
/// The kernels decide in binary64 where its error bound allows. What it does not decide, they leave as it was and list
/// as undecided; the caller decides it exactly (exact.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/exact.h"
#include "raster/face.h"
#include "raster/screen_triangle.h"

namespace hemitex::raster {

/// Kernels work on up to so many pixels at a time, and may touch as many behind the end of a row.
inline constexpr int mostLanes = 16;

/// What the pixels of a part of a face show so far, row-major; no triangle where the background is.
struct DepthBuffer {
  Scissor scissor;        ///< the part
  std::size_t pitch = 0;  ///< pixels from row to row: the width and mostLanes
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

/// Samples that binary64 does not decide.
struct UndecidedPixels {
  std::vector<Pixel> pixels;

  void add(int column, int row);  // not inline: kernels are compiled for other instruction sets than the rest
};

/// Pixels of a row that show one triangle.
struct PixelRun {
  const ScreenTriangle* triangle;
  int row, firstColumn, count;
  const double* inverseDepth;  ///< of each, from the depth buffer
};

/// A texture coordinate of a triangle in texels, over w: at + down * row + right * column. All is binary64, for each
/// run of pixels would convert it anew.
struct TexelPlane {
  double at = 0, down = 0, right = 0;
  double last = 0;    ///< the last texel
  double middle = 0;  ///< where in a texel a position is farthest from borders that count: a single texel is
                      ///< everywhere, at 0
};

/// Both texture coordinates of a triangle in an index map. A position in texels, (at + down * row) + right * column
/// times w, is off by at most error * w + rounding.
struct TexelPlanes {
  TexelPlane u, v;
  double error = 0, rounding = 0;

  TexelPlanes(const ScreenTriangle& triangle, int mapWidth, int mapHeight);
};

/// Both texture coordinates of a triangle as quotients that binary64 decides everywhere (exact.h).
struct ExactTexels {
  ExactQuotient u, v;
};

struct PixelKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// Offers the covered samples of a triangle to a buffer whose scissor rectangle its rows and columns lie in: the
  /// larger 1/w wins. Appends samples where binary64 cannot tell which. Returns whether any pixel took the triangle,
  /// whose number is not in the buffer before.
  bool (*offer)(const ScreenTriangle& triangle, std::uint32_t number, DepthBuffer& buffer, UndecidedPixels& undecided);

  /// Whether all pixels of a part of the buffer's scissor rectangle show something nearer than 1/w = inverseDepth,
  /// which is more than rounding beyond what it stands for.
  bool (*isHidden)(const DepthBuffer& buffer, const Scissor& part, double inverseDepth);

  /// The pixel behind the last that shows the same triangle as pixel `first`, at most `end`.
  int (*endOfRun)(const std::uint32_t* triangles, int first, int end);

  /// The texels of a run, at most mostLanes more than it has: `base` and row * width + column each. Appends those that
  /// binary64 cannot tell; what `texels` says of them is not to be used.
  void (*findTexels)(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base, std::uint32_t* texels,
                     UndecidedPixels& undecided);

  /// The same of a triangle whose coordinates are exact quotients: it takes longer, and decides all.
  void (*findExactTexels)(const PixelRun& run, const ExactTexels& exact, int width, int height, std::uint32_t base,
                          std::uint32_t* texels);
};

/// The specification of the others.
const PixelKernels& plainKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<PixelKernels>& simdKernels();
/// The first of simdKernels(), else the plain ones.
const PixelKernels& bestKernels();

}  // namespace hemitex::raster
