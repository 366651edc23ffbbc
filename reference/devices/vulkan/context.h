/// A Vulkan device without a window: the first one with the required features.
#pragma once

#include <cstdint>
#include <optional>
#include <vulkan/vulkan_raii.hpp>

namespace hemitex::reference {

/// Members are destroyed in reverse order, the device before its instance.
struct VulkanContext {
  vk::raii::Context loader;
  vk::raii::Instance instance;
  vk::raii::PhysicalDevice physicalDevice;
  std::uint32_t queueFamily;
  vk::raii::Device device;
  vk::raii::Queue queue;
};

/// Requires Vulkan 1.3, double precision in shaders, and 8 bits of sub-pixel precision, with which the device snaps
/// corners as the rules do. Returns nothing if no device has them, or if there is no driver.
std::optional<VulkanContext> openVulkanDevice();

}  // namespace hemitex::reference
