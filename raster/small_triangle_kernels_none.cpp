// In place of the kernels on vectors where hemitex is built without SIMD.
#include "raster/small_triangle_kernels.h"

namespace hemitex::raster {

const std::vector<SmallTriangleKernels>& simdSmallTriangleKernels() {
  static const std::vector<SmallTriangleKernels> none;
  return none;
}

}  // namespace hemitex::raster
