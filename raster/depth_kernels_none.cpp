// In place of the kernels on vectors where hemitex is built without SIMD.
#include "raster/depth_kernels.h"

namespace hemitex::raster {

const std::vector<DepthKernels>& simdDepthKernels() {
  static const std::vector<DepthKernels> none;
  return none;
}

}  // namespace hemitex::raster
