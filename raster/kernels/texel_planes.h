/// Texture coordinates along runs of pixels that show one triangle: as planes in double precision with error bounds, or
/// as exact quotients.
#pragma once

#include <cstdint>
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
  const double* inverseDepth;  ///< per pixel, from the depth buffer
};

/// A texture coordinate of a triangle in texels, over w: at + down * row + right * column. All members are doubles,
/// because each run of pixels would have to convert them otherwise.
struct TexelPlane {
  double at = 0, down = 0, right = 0;
  double last = 0;  ///< the last texel
  double middle =
      0;  ///< position in a texel that is farthest from a border: 1/2; 0 for a single texel, which has no borders
};

/// Both texture coordinates of a triangle in an index map. The error of a position, ((at + down * row) + right *
/// column) * w, is at most error * w + rounding, in texels.
struct TexelPlanes {
  TexelPlane u, v;
  double error = 0, rounding = 0;

  TexelPlanes(const ScreenTriangle& triangle, int mapWidth, int mapHeight);
};

/// Both texture coordinates of a triangle as exact quotients (exact_interpolation.h).
struct ExactTexels {
  ExactQuotient u, v;
};

/// An exact quotient along the pixels of a run: (at + i * step) / (below + i * belowStep), for i from 0. Only the
/// quotient is rounded.
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

}  // namespace hemitex::raster
