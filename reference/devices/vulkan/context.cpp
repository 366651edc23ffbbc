#include "reference/devices/vulkan/context.h"

#include <exception>
#include <optional>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

constexpr const char* howToGetOne =
    "install a driver of Vulkan 1.3 with double precision in shaders; Mesa's lavapipe needs no graphics card";

/// One for the process: drivers allow a few only, and making one takes longer than a hemicube.
const vk::raii::Instance& instance() {
  static const vk::raii::Context loader;
  static const vk::ApplicationInfo application{.apiVersion = VK_API_VERSION_1_3};
  static const vk::raii::Instance instance(loader, vk::InstanceCreateInfo{.pApplicationInfo = &application});
  return instance;
}

std::optional<std::uint32_t> graphicsFamily(const vk::raii::PhysicalDevice& device) {
  const std::vector<vk::QueueFamilyProperties> families = device.getQueueFamilyProperties();
  for (std::uint32_t f = 0; f < families.size(); ++f)
    if (families[f].queueFlags & vk::QueueFlagBits::eGraphics) return f;
  return std::nullopt;
}

bool isSuitable(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  const vk::FormatProperties depth = device.getFormatProperties(vk::Format::eD32Sfloat);
  return properties.apiVersion >= VK_API_VERSION_1_3 && properties.limits.subPixelPrecisionBits >= 8 &&
         device.getFeatures().shaderFloat64 && graphicsFamily(device) &&
         (depth.optimalTilingFeatures & vk::FormatFeatureFlagBits::eDepthStencilAttachment);
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physicalDevice, std::uint32_t queueFamily) {
  const float priority = 1;
  const auto queue = vk::DeviceQueueCreateInfo{.queueFamilyIndex = queueFamily}.setQueuePriorities(priority);
  const vk::PhysicalDeviceFeatures features{.shaderFloat64 = true};
  const vk::PhysicalDeviceVulkan13Features features13{.synchronization2 = true, .dynamicRendering = true};
  const vk::DeviceCreateInfo info{.pNext = &features13, .pEnabledFeatures = &features};
  return {physicalDevice, vk::DeviceCreateInfo(info).setQueueCreateInfos(queue)};
}

}  // namespace

std::string nameOf(const VulkanContext& context) { return context.physicalDevice.getProperties().deviceName; }

VulkanContext openVulkanDevice(const std::string& name) try {
  std::string others;
  for (vk::raii::PhysicalDevice& candidate : vk::raii::PhysicalDevices(instance())) {
    const std::string found = candidate.getProperties().deviceName;
    if (isSuitable(candidate) && found.find(name) != std::string::npos) {
      const std::uint32_t family = *graphicsFamily(candidate);
      vk::raii::Device device = makeDevice(candidate, family);
      vk::raii::Queue queue(device, family, 0);
      return {std::move(candidate), family, std::move(device), std::move(queue)};
    }
    others += (others.empty() ? "; there is " : ", ") + found;
  }
  const std::string named = name.empty() ? " answers" : " has \"" + name + "\" in its name";
  throw raster::InputError("no Vulkan device with the required features" + named + others, howToGetOne);
} catch (const raster::InputError&) {
  throw;
} catch (const std::exception& error) {
  // The loader reports a missing library or driver by different exceptions.
  throw raster::InputError(std::string("no Vulkan device answers: ") + error.what(), howToGetOne);
}

}  // namespace hemitex::reference
