#include "cli/devices/renderers.h"
#include "reference/devices/vulkan/vulkan_renderer.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name) {
  using reference::VulkanPath;
  return reference::makeVulkanRenderer(list, name,
                                       device == Device::VulkanCompute ? VulkanPath::Compute : VulkanPath::Graphics);
}

std::string vulkanDeviceName(const std::string& name) { return reference::vulkanDeviceName(name); }

}  // namespace hemitex::cli
