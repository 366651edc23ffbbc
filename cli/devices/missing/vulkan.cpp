#include "cli/devices/renderers.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList&) {
  throw raster::InputError("this program was built without Vulkan",
                           "install libvulkan-dev and glslang-tools and build hemitex again");
}

}  // namespace hemitex::cli
