#include "raster/kernels/small_triangles.h"

namespace hemitex::raster {

void UnresolvedSamples::add(const SmallSample& sample) { samples.push_back(sample); }

}  // namespace hemitex::raster
