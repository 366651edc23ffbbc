// Replaces all SIMD kernels in a build without SIMD: the lists are empty.
#include "raster/kernels/depth_kernels.h"
#include "raster/kernels/run_kernels.h"
#include "raster/kernels/small_triangle_kernels.h"
#include "raster/kernels/texel_kernels.h"
#include "raster/kernels/vertex_kernels.h"

namespace hemitex::raster {
namespace {

template <typename Kernels>
const std::vector<Kernels>& none() {
  static const std::vector<Kernels> empty;
  return empty;
}

}  // namespace

const std::vector<VertexKernels>& simdVertexKernels() { return none<VertexKernels>(); }
const std::vector<SmallTriangleKernels>& simdSmallTriangleKernels() { return none<SmallTriangleKernels>(); }
const std::vector<DepthKernels>& simdDepthKernels() { return none<DepthKernels>(); }
const std::vector<TexelKernels>& simdTexelKernels() { return none<TexelKernels>(); }
const std::vector<RunKernels>& simdRunKernels() { return none<RunKernels>(); }

}  // namespace hemitex::raster
