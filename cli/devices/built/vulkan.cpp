#include "cli/devices/renderers.h"
#include "reference/devices/vulkan/vulkan_renderer.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list, const std::string& name) {
  return reference::makeVulkanRenderer(list, name);
}

std::string vulkanDeviceName(const std::string& name) { return reference::vulkanDeviceName(name); }

}  // namespace hemitex::cli
