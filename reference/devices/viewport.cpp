#include "reference/devices/viewport.h"

#include "raster/base/input_error.h"

namespace hemitex::reference {

DeviceViewport viewportOf(const raster::Face& face, int width, int largest, const std::string& api) {
  if (face.resolution > largest)
    throw raster::InputError("a face is larger than the viewport of the " + api + " device",
                             "use a resolution of at most " + std::to_string(largest));
  while (width * face.resolution > largest) width /= 2;
  const int beside = (width - 1) * face.resolution / 2;
  return {width, -beside - face.scissor.column, -beside - face.scissor.row, width * face.resolution};
}

}  // namespace hemitex::reference
