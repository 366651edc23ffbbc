#include "cli/devices/renderers.h"

#include "raster/software/software_renderer.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device) {
  if (device == Device::Software) return std::make_unique<raster::SoftwareRenderer>(list);
  if (device == Device::Vulkan) return makeVulkanRenderer(list);
  return makeOpenGlRenderer(list, device);
}

}  // namespace hemitex::cli
