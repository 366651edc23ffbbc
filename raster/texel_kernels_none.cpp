// In place of the kernels on vectors where hemitex is built without SIMD.
#include "raster/texel_kernels.h"

namespace hemitex::raster {

const std::vector<TexelKernels>& simdTexelKernels() {
  static const std::vector<TexelKernels> none;
  return none;
}

}  // namespace hemitex::raster
