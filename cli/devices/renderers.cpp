#include "cli/devices/renderers.h"

#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"

namespace hemitex::cli {
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

/// Tests the device with an empty draw list, because an OpenGL context is made only for a renderer.
std::function<std::unique_ptr<raster::ItemBufferRenderer>(const raster::DrawList&)> openGlRenderers(
    Device device, Console& console, const std::string& without) {
  const auto make = [device](const raster::DrawList& list) { return makeRenderer(list, device); };
  try {
    raster::DrawList empty;
    empty.format = *raster::formatNamed("r8g8b8a8");
    make(empty);
    console.message("OpenGL draws with " + deviceName(device));
    return make;
  } catch (const raster::InputError& error) {
    console.message(without + ": " + error.what());
    return {};
  }
}

}  // namespace hemitex::cli
