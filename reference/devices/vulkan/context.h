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
};

/// Opens the first device whose name contains `name`. Requires Vulkan 1.3, double precision in shaders, and 8 bits of
/// sub-pixel precision, with which the device snaps corners as the rules do. Throws InputError if no device has them,
/// with the names of the others, or if the loader or a driver fails, with its message.
VulkanContext openVulkanDevice(const std::string& name = "");

std::string nameOf(const VulkanContext& context);

}  // namespace hemitex::reference
