#include "reference/devices/choice/renderers.h"

#include "raster/software/software_renderer.h"

namespace hemitex::reference {
namespace {

bool isVulkan(Device device) { return device == Device::Vulkan || device == Device::VulkanCompute; }

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device,
                                                         const std::string& name) {
  if (device == Device::Software) return std::make_unique<raster::SoftwareRenderer>(list);
  if (isVulkan(device)) return makeVulkanRenderer(list, device, name);
  return makeOpenGlRenderer(list, device, name);
}

std::string deviceName(Device device, const std::string& name) {
  if (device == Device::Software) return "";
  return isVulkan(device) ? vulkanDeviceName(name) : openGlDeviceName(name);
}

const std::vector<std::pair<std::string, Device>>& rowDevices() {
  static const std::vector<std::pair<std::string, Device>> devices{{"software", Device::Software},
                                                                   {"vulkan", Device::Vulkan},
                                                                   {"vulkan-compute", Device::VulkanCompute},
                                                                   {"opengl", Device::OpenGl}};
  return devices;
}

}  // namespace hemitex::reference
