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

bool addsInt64(const vk::raii::PhysicalDevice& device) {
  const auto features = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
  return features.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 &&
         features.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics;
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physicalDevice, std::uint32_t queueFamily) {
  const float priority = 1;
  const auto queue = vk::DeviceQueueCreateInfo{.queueFamilyIndex = queueFamily}.setQueuePriorities(priority);
  const bool int64 = addsInt64(physicalDevice);
  const vk::PhysicalDeviceFeatures features{.shaderFloat64 = true, .shaderInt64 = int64};
  vk::PhysicalDeviceVulkan12Features features12{.shaderBufferInt64Atomics = int64};
  // The compiler of shaders states the sizes of workgroups in a way that needs maintenance4; all of Vulkan 1.3 have it.
  const vk::PhysicalDeviceVulkan13Features features13{
      .pNext = &features12, .synchronization2 = true, .dynamicRendering = true, .maintenance4 = true};
  const vk::DeviceCreateInfo info{.pNext = &features13, .pEnabledFeatures = &features};
  return {physicalDevice, vk::DeviceCreateInfo(info).setQueueCreateInfos(queue)};
}

}  // namespace

std::string nameOf(const vk::raii::PhysicalDevice& device) {
  const auto properties = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const auto& driver = properties.get<vk::PhysicalDeviceDriverProperties>();
  return std::string(properties.get<vk::PhysicalDeviceProperties2>().properties.deviceName.data()) + ", " +
         driver.driverName.data() + " " + driver.driverInfo.data();
}

VulkanContext openVulkanDevice(const std::string& name) try {
  std::string others;
  for (vk::raii::PhysicalDevice& candidate : vk::raii::PhysicalDevices(instance())) {
    const std::string found = nameOf(candidate);
    if (isSuitable(candidate) && found.find(name) != std::string::npos) {
      const std::uint32_t family = *graphicsFamily(candidate);
      vk::raii::Device device = makeDevice(candidate, family);
      vk::raii::Queue queue(device, family, 0);
      const bool int64 = addsInt64(candidate);
      return {std::move(candidate), family, std::move(device), std::move(queue), int64};
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
