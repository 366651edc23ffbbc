/// The samples whose depth test is not resolved in double precision.
#pragma once

#include <cstdint>

#include "raster/kernels/depth_buffer.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Appends the samples of a triangle whose depth test against the buffer is not resolved in double precision. No other
/// triangle in the buffer may have its number.
void listUnresolvedSamples(const ScreenTriangle& triangle, std::uint32_t number, const DepthBuffer& buffer,
                           UnresolvedPixels& unresolved);

}  // namespace hemitex::raster
