/// The viewport of a face on a real device, which clips triangles at the sides of its viewport.
#pragma once

#include <string>

#include "raster/interface/face.h"

namespace hemitex::reference {

/// A rectangle of pixels with the face in its middle. The framebuffer shows the scissor rectangle of the face.
struct DeviceViewport {
  int x, y;           ///< its first column and row in the framebuffer
  int columns, rows;  ///< those of the face, and the same number of pixels on either side
};

/// A viewport `width` times as wide and as high as the face, or a half, a quarter or an eighth of that along a side
/// where the device allows only `largest` pixels. With 8 it is as wide as the guard band of the rules; where the face
/// has an odd number of pixels, it has one less. Throws InputError, which names the device by its `api`, if the face
/// itself is larger.
DeviceViewport viewportOf(const raster::Face& face, int width, int largest, const std::string& api);

}  // namespace hemitex::reference
