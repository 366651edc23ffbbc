// In place of the kernels on vectors where hemitex is built without SIMD.
#include "raster/word_kernels.h"

namespace hemitex::raster {

const std::vector<WordKernels>& simdWordKernels() {
  static const std::vector<WordKernels> none;
  return none;
}

}  // namespace hemitex::raster
