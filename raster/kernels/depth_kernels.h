/// Depth kernels: the depth test of a triangle's samples, and what depth buffers are asked. There is a plain version,
/// which says what they compute, and one for each SIMD instruction set that the processor has; all give the same
/// numbers, bit for bit.
///
/// The kernels decide in binary64 where its error bound (interpolation_bounds.h) allows. What it does not decide, they
/// leave as it was and list as undecided; the caller decides it exactly (exact_interpolation.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "raster/interface/face.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

struct DepthKernels {
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
};

/// The specification of the others.
const DepthKernels& plainDepthKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<DepthKernels>& simdDepthKernels();
/// The first of simdDepthKernels(), else the plain ones.
const DepthKernels& bestDepthKernels();

/// Appends the samples of a triangle, by its number, that a buffer to which it was offered leaves undecided. No other
/// triangle in the buffer has that number.
void listUndecidedSamples(const ScreenTriangle& triangle, std::uint32_t number, const DepthBuffer& buffer,
                          UndecidedPixels& undecided);

}  // namespace hemitex::raster
