#include "cli/devices/renderers.h"
#include "reference/devices/vulkan/vulkan_renderer.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list) {
  return reference::makeVulkanRenderer(list);
}

}  // namespace hemitex::cli
