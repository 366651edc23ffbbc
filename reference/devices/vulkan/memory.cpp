#include "reference/devices/vulkan/memory.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

/// Memory with the first of `choices` that the device has.
vk::raii::DeviceMemory allocate(const VulkanContext& context, const vk::MemoryRequirements& requirements,
                                std::initializer_list<vk::MemoryPropertyFlags> choices) {
  const vk::PhysicalDeviceMemoryProperties memory = context.physicalDevice.getMemoryProperties();
  if (const auto type = memoryType(memory, requirements.memoryTypeBits, choices))
    return {context.device, vk::MemoryAllocateInfo{.allocationSize = requirements.size, .memoryTypeIndex = *type}};
  throw raster::InputError("the Vulkan device has no memory for this use");
}

}  // namespace

std::optional<std::uint32_t> memoryType(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                        std::initializer_list<vk::MemoryPropertyFlags> choices) {
  for (const vk::MemoryPropertyFlags properties : choices)
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
      if ((allowed >> type & 1) && (memory.memoryTypes[type].propertyFlags & properties) == properties) return type;
  return std::nullopt;
}

VulkanBuffer makeBuffer(const VulkanContext& context, std::size_t size, vk::BufferUsageFlags usage) {
  using Property = vk::MemoryPropertyFlagBits;
  vk::raii::Buffer buffer(context.device, vk::BufferCreateInfo{.size = size, .usage = usage});
  const vk::MemoryPropertyFlags shared = Property::eHostVisible | Property::eHostCoherent;
  // Reading memory that is not cached takes longer than drawing.
  const bool isRead = static_cast<bool>(usage & vk::BufferUsageFlagBits::eTransferDst);
  vk::raii::DeviceMemory memory =
      allocate(context, buffer.getMemoryRequirements(), {isRead ? shared | Property::eHostCached : shared, shared});
  buffer.bindMemory(*memory, 0);
  auto* const bytes = static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
  return {std::move(memory), std::move(buffer), bytes};
}

VulkanBuffer makeStorageBuffer(const VulkanContext& context, std::span<const std::byte> content) {
  const std::uint32_t largest = context.physicalDevice.getProperties().limits.maxStorageBufferRange;
  if (content.size() > largest)
    throw raster::InputError("the draw list is larger than the buffers of the Vulkan device",
                             "use at most " + std::to_string(largest) + " bytes of corners or of index maps");
  // An empty buffer is not allowed.
  VulkanBuffer buffer =
      makeBuffer(context, std::max<std::size_t>(content.size(), 4), vk::BufferUsageFlagBits::eStorageBuffer);
  std::copy(content.begin(), content.end(), buffer.bytes);
  return buffer;
}

VulkanImage makeImage(const VulkanContext& context, vk::Format format, vk::ImageAspectFlags aspect,
                      vk::ImageUsageFlags usage, vk::Extent2D size) {
  vk::raii::Image image(context.device, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                                            .format = format,
                                                            .extent = {size.width, size.height, 1},
                                                            .mipLevels = 1,
                                                            .arrayLayers = 1,
                                                            .usage = usage});
  vk::raii::DeviceMemory memory =
      allocate(context, image.getMemoryRequirements(), {vk::MemoryPropertyFlagBits::eDeviceLocal});
  image.bindMemory(*memory, 0);
  vk::raii::ImageView view(context.device, vk::ImageViewCreateInfo{.image = *image,
                                                                   .viewType = vk::ImageViewType::e2D,
                                                                   .format = format,
                                                                   .subresourceRange = {aspect, 0, 1, 0, 1}});
  return {std::move(memory), std::move(image), std::move(view)};
}

}  // namespace hemitex::reference
