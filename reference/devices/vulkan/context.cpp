#include "reference/devices/vulkan/context.h"

#include <exception>

namespace hemitex::reference {
namespace {

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

std::optional<VulkanContext> openVulkanDevice() try {
  vk::raii::Context loader;
  const vk::ApplicationInfo application{.apiVersion = VK_API_VERSION_1_3};
  vk::raii::Instance instance(loader, vk::InstanceCreateInfo{.pApplicationInfo = &application});
  for (vk::raii::PhysicalDevice& candidate : vk::raii::PhysicalDevices(instance)) {
    if (!isSuitable(candidate)) continue;
    const std::uint32_t family = *graphicsFamily(candidate);
    vk::raii::Device device = makeDevice(candidate, family);
    vk::raii::Queue queue(device, family, 0);
    return VulkanContext{std::move(loader), std::move(instance), std::move(candidate), family,
                         std::move(device), std::move(queue)};
  }
  return std::nullopt;
} catch (const std::exception&) {
  // The loader reports a missing library or driver by different exceptions.
  return std::nullopt;
}

}  // namespace hemitex::reference
