#include "raster/base/input_error.h"
#include "reference/devices/choice/renderers.h"

namespace hemitex::reference {

std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList&, Device,
                                                               const std::string& name) {
  openGlDeviceName(name);
  return nullptr;
}

std::string openGlDeviceName(const std::string&) {
  throw raster::InputError("this program was built without OpenGL", "install libepoxy-dev and build hemitex again");
}

}  // namespace hemitex::reference
