#include "raster/base/input_error.h"
#include "reference/devices/choice/renderers.h"

namespace hemitex::reference {

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList&, Device,
                                                               const std::string& name) {
  vulkanDeviceName(name);
  return nullptr;
}

std::string vulkanDeviceName(const std::string&) {
  throw raster::InputError("this program was built without Vulkan",
                           "install libvulkan-dev and glslang-tools and build hemitex again");
}

}  // namespace hemitex::reference
