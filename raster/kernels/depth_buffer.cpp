#include "raster/kernels/depth_buffer.h"

namespace hemitex::raster {

void DepthBuffer::clear(const Scissor& part) {
  scissor = part;
  pitch = static_cast<std::size_t>(part.width + maxLanes);
  inverseDepth.assign(pitch * static_cast<std::size_t>(part.height), 0);
  triangle.assign(inverseDepth.size(), noTriangle);
  id.resize(inverseDepth.size());
}

void UnresolvedPixels::add(int column, int row) { pixels.push_back({column, row}); }

}  // namespace hemitex::raster
