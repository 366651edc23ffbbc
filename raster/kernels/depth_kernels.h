/// Depth kernels: the depth test of the samples of a triangle, and queries of depth buffers. The scalar version is the
/// specification. There is one more version per SIMD instruction set of the processor, with the same results, bit for
/// bit.
///
/// The kernels decide in double precision where its error bound (interpolation_bounds.h) allows. They leave other
/// pixels unchanged and list them as undecided; the caller decides those exactly (exact_interpolation.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "raster/interface/face.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/kernel_lists.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

struct DepthKernels {
  std::string name;  ///< "scalar", or the name of an instruction set

  /// Depth test of the covered samples of a triangle: the larger 1/w wins. Rows and columns of the triangle must lie in
  /// the scissor rectangle of the buffer, and the buffer must not contain `number` before. Appends the samples that are
  /// not resolved in double precision. Returns whether any pixel took the triangle.
  bool (*offer)(const ScreenTriangle& triangle, std::uint32_t number, DepthBuffer& buffer, UndecidedPixels& undecided);

  /// Whether 1/w of all pixels in a part of the buffer's scissor rectangle is larger than `inverseDepth`. The caller
  /// adds the rounding error to inverseDepth.
  bool (*isHidden)(const DepthBuffer& buffer, const Scissor& part, double inverseDepth);

  /// The end of the run of pixels from `first` that show the same triangle; at most `end`.
  int (*endOfRun)(const std::uint32_t* triangles, int first, int end);

  /// The end of the pixels from `first` that show small triangles; at most `end`.
  int (*endOfSmall)(const std::uint32_t* triangles, int first, int end);
};

template <>
const DepthKernels& scalarKernels<DepthKernels>();
template <>
const std::vector<DepthKernels>& simdKernels<DepthKernels>();

/// Appends the samples of a triangle whose depth test against the buffer is not resolved in double precision. No other
/// triangle in the buffer may have its number.
void listUndecidedSamples(const ScreenTriangle& triangle, std::uint32_t number, const DepthBuffer& buffer,
                          UndecidedPixels& undecided);

}  // namespace hemitex::raster
