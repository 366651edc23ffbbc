#include "reference/devices/choice/renderers.h"
#include "reference/devices/vulkan/vulkan_renderer.h"

namespace hemitex::reference {

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name) {
  return makeVulkanRenderer(list, name, device == Device::VulkanCompute ? VulkanPath::Compute : VulkanPath::Graphics);
}

}  // namespace hemitex::reference
