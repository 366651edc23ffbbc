#include "cli/common/renderers.h"
#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device) {
  if (device != Device::Software)
    throw raster::InputError("this program was built without OpenGL", "install libepoxy-dev and build hemitex again");
  return std::make_unique<raster::SoftwareRenderer>(list);
}

}  // namespace hemitex::cli
