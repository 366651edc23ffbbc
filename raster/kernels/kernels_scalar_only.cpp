// Replaces all SIMD kernels in a build without SIMD: the lists are empty.
#include "raster/kernels/depth_kernels.h"
#include "raster/kernels/run_kernels.h"
#include "raster/kernels/small_triangle_kernels.h"
#include "raster/kernels/texel_kernels.h"
#include "raster/kernels/vertex_kernels.h"

namespace hemitex::raster {

template <>
const std::vector<VertexKernels>& simdKernels<VertexKernels>() {
  static const std::vector<VertexKernels> none;
  return none;
}

template <>
const std::vector<SmallTriangleKernels>& simdKernels<SmallTriangleKernels>() {
  static const std::vector<SmallTriangleKernels> none;
  return none;
}

template <>
const std::vector<DepthKernels>& simdKernels<DepthKernels>() {
  static const std::vector<DepthKernels> none;
  return none;
}

template <>
const std::vector<TexelKernels>& simdKernels<TexelKernels>() {
  static const std::vector<TexelKernels> none;
  return none;
}

template <>
const std::vector<RunKernels>& simdKernels<RunKernels>() {
  static const std::vector<RunKernels> none;
  return none;
}

}  // namespace hemitex::raster
