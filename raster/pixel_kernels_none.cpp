// In place of the kernels on vectors where hemitex is built without SIMD.
#include "raster/pixel_kernels.h"

namespace hemitex::raster {

const std::vector<PixelKernels>& simdKernels() {
  static const std::vector<PixelKernels> none;
  return none;
}

}  // namespace hemitex::raster
