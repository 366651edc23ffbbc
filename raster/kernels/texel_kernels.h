/// Texel kernels: the texels of a run of pixels that show one triangle. There is a plain version, which says what they
/// compute, and one for each SIMD instruction set that the processor has; all give the same numbers, bit for bit.
///
/// The kernels decide in floating point where its error bound (texel_kernels.cpp) allows. What it does not decide, they
/// list as undecided; the caller decides it exactly (exact_interpolation.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/interpolation_bounds.h"
#include "raster/setup/exact_interpolation.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

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

/// Both texture coordinates of a triangle as quotients that binary64 decides everywhere (exact_interpolation.h).
struct ExactTexels {
  ExactQuotient u, v;
};

/// An exact quotient along pixels of a row that show one triangle: (at + i * step) / (below + i * belowStep), for i
/// from 0. Nothing is rounded but the quotient.
struct ExactLine {
  double at = 0, step = 0;
  double below = 0, belowStep = 0;

  ExactLine(const PixelRun& run, const ExactQuotient& quotient) {
    const EdgeValues first = edgeValues(*run.triangle, run.firstColumn, run.row);
    const EdgeValues steps = edgeSteps(*run.triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      at += first[k] * quotient.numerator[k];
      step += steps[k] * quotient.numerator[k];
      below += first[k] * quotient.denominator[k];
      belowStep += steps[k] * quotient.denominator[k];
    }
  }
};

struct TexelKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// The texels of a run: `base` and row * width + column each. Appends pixels whose texels binary64 cannot tell; what
  /// `texels` says of them is not to be used. Kernels may write up to maxLanes more texels behind the run's, and read
  /// as many more depths.
  void (*findTexels)(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base, std::uint32_t* texels,
                     UndecidedPixels& undecided);

  /// The same of a triangle whose coordinates are exact quotients: it takes longer, and decides all.
  void (*findExactTexels)(const PixelRun& run, const ExactTexels& exact, int width, int height, std::uint32_t base,
                          std::uint32_t* texels);
};

/// The specification of the others.
const TexelKernels& plainTexelKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<TexelKernels>& simdTexelKernels();
/// The first of simdTexelKernels(), else the plain ones.
const TexelKernels& bestTexelKernels();

}  // namespace hemitex::raster
