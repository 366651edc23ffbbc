/// A Vulkan device without a window: the first one with the required features.
#pragma once

#include <cstdint>
#include <string>
#include <vulkan/vulkan_raii.hpp>

namespace hemitex::reference {

/// Members are destroyed in reverse order. The instance stays until the process ends.
struct VulkanContext {
  vk::raii::PhysicalDevice physicalDevice;
  std::uint32_t queueFamily;
  vk::raii::Device device;
  vk::raii::Queue queue;
  bool addsInt64;  ///< whether shaders add integers of 64 bits to buffers in one step
};

/// Opens the first device whose name contains `name`. Requires Vulkan 1.3, double precision in shaders, and 8 bits of
/// sub-pixel precision, with which the device snaps corners as the rules do. Throws InputError if no device has them,
/// with the names of the others, or if the loader or a driver fails, with its message.
VulkanContext openVulkanDevice(const std::string& name = "");

/// The name of a device, and those of its driver and of the version of it.
std::string nameOf(const vk::raii::PhysicalDevice& device);

}  // namespace hemitex::reference
