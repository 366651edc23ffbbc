/// Buffers and images, each with memory of its own.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>

#include "reference/devices/vulkan/context.h"

namespace hemitex::reference {

/// The first of the allowed types of memory, a bit each, that has the properties of the first choice that any has.
std::optional<std::uint32_t> memoryType(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                        std::initializer_list<vk::MemoryPropertyFlags> choices);

/// A buffer that the device and this program both read and write.
struct VulkanBuffer {
  vk::raii::DeviceMemory memory;
  vk::raii::Buffer buffer;
  std::byte* bytes;  ///< in the address space of this program
};

VulkanBuffer makeBuffer(const VulkanContext& context, std::size_t size, vk::BufferUsageFlags usage);
/// A storage buffer for shaders. Throws InputError if it is larger than the device allows.
VulkanBuffer makeStorageBuffer(const VulkanContext& context, std::span<const std::byte> content);

/// An image that is rendered to.
struct VulkanImage {
  vk::raii::DeviceMemory memory;
  vk::raii::Image image;
  vk::raii::ImageView view;
};

VulkanImage makeImage(const VulkanContext& context, vk::Format format, vk::ImageAspectFlags aspect,
                      vk::ImageUsageFlags usage, vk::Extent2D size);

}  // namespace hemitex::reference
