/// Buffers and images, each with memory of its own.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "reference/devices/vulkan/context.h"

namespace hemitex::reference {

/// The first of the allowed types of memory, a bit each, that has the properties of the first choice that any has.
std::optional<std::uint32_t> memoryType(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                        std::initializer_list<vk::MemoryPropertyFlags> choices);

/// Who writes a buffer, and who reads it.
enum class BufferUse {
  Input,   ///< this program writes it, and the device reads it from memory of its own if this program reaches that
  Output,  ///< the device writes it, and this program reads it
  Device,  ///< the device alone
};

struct VulkanBuffer {
  vk::raii::DeviceMemory memory;
  vk::raii::Buffer buffer;
  std::byte* bytes;  ///< in the address space of this program; null in memory of the device alone
};

/// A storage buffer that commands copy, too; of at least one byte.
VulkanBuffer makeBuffer(const VulkanContext& context, std::size_t size, BufferUse use);
/// An input with this content. Throws InputError if it is larger than the device allows.
VulkanBuffer makeStorageBuffer(const VulkanContext& context, std::span<const std::byte> content);

/// The layers of an image that is rendered to.
struct VulkanImage {
  vk::raii::DeviceMemory memory;
  vk::raii::Image image;
  vk::raii::ImageView view;                 ///< of all layers
  std::vector<vk::raii::ImageView> layers;  ///< each alone
};

VulkanImage makeImage(const VulkanContext& context, vk::Format format, vk::ImageAspectFlags aspect,
                      vk::ImageUsageFlags usage, vk::Extent2D size, std::uint32_t layers);

/// Compute shaders that follow wait for what compute shaders, copies and fills before wrote.
void awaitWrites(const vk::raii::CommandBuffer& commands);

}  // namespace hemitex::reference
