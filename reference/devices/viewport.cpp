#include "reference/devices/viewport.h"

#include <algorithm>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

/// The pixels on one side of the face.
int pixelsBeside(int pixels, int width, int largest) {
  while (width * pixels > largest) width /= 2;
  return (width - 1) * pixels / 2;
}

}  // namespace

DeviceViewport viewportOf(const raster::Face& face, int width, int largest, const std::string& api) {
  const raster::Viewport size = raster::viewportOf(face);
  if (std::max(size.columns, size.rows) > largest)
    throw raster::InputError("a face is larger than the viewport of the " + api + " device",
                             "use a resolution of at most " + std::to_string(largest));
  const int left = pixelsBeside(size.columns, width, largest), above = pixelsBeside(size.rows, width, largest);
  return {-left - face.scissor.column, -above - face.scissor.row, size.columns + 2 * left, size.rows + 2 * above};
}

}  // namespace hemitex::reference
