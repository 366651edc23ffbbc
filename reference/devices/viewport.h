/// The viewport of a face on a real device, which clips triangles at the sides of its viewport.
#pragma once

#include <string>

#include "raster/interface/face.h"

namespace hemitex::reference {

/// A square of pixels with the face in its middle. The framebuffer shows the scissor rectangle of the face.
struct DeviceViewport {
  int width;       ///< in faces
  int x, y, side;  ///< of its first column and row in the framebuffer, and of its side, in pixels
};

/// A viewport of `width` faces, or a half, a quarter or an eighth of that if the device allows only `largest` pixels a
/// side. With 8 faces it is as wide as the guard band of the rules. Throws InputError, which names the device by its
/// `api`, if the face itself is larger.
DeviceViewport viewportOf(const raster::Face& face, int width, int largest, const std::string& api);

}  // namespace hemitex::reference
