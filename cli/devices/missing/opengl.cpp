#include "cli/devices/renderers.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList&, Device) {
  throw raster::InputError("this program was built without OpenGL", "install libepoxy-dev and build hemitex again");
}

}  // namespace hemitex::cli
