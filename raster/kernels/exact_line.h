/// Exact quotients along a run of pixels.
#pragma once

#include <cstddef>

#include "raster/kernels/interpolation_bounds.h"
#include "raster/kernels/texel_kernels.h"
#include "raster/setup/exact_interpolation.h"

namespace hemitex::raster {

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

}  // namespace hemitex::raster
