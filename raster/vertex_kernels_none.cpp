// In place of the kernels on vectors where hemitex is built without SIMD.
#include "raster/vertex_kernels.h"

namespace hemitex::raster {

const std::vector<VertexKernels>& simdVertexKernels() {
  static const std::vector<VertexKernels> none;
  return none;
}

}  // namespace hemitex::raster
