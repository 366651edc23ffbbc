#include "reference/devices/vulkan/memory.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

/// Memory with the first of `choices` that the device has, and has room for.
vk::raii::DeviceMemory allocate(const VulkanContext& context, const vk::MemoryRequirements& requirements,
                                std::initializer_list<vk::MemoryPropertyFlags> choices) {
  const vk::PhysicalDeviceMemoryProperties memory = context.physicalDevice.getMemoryProperties();
  for (const vk::MemoryPropertyFlags choice : choices)
    if (const auto type = memoryType(memory, requirements.memoryTypeBits, {choice})) try {
        return {context.device, vk::MemoryAllocateInfo{.allocationSize = requirements.size, .memoryTypeIndex = *type}};
      } catch (const vk::OutOfDeviceMemoryError&) {
        continue;
      }
  throw raster::InputError("the Vulkan device has no memory for this use");
}

std::initializer_list<vk::MemoryPropertyFlags> memoryFor(BufferUse use) {
  using Property = vk::MemoryPropertyFlagBits;
  static constexpr vk::MemoryPropertyFlags shared = Property::eHostVisible | Property::eHostCoherent,
                                           local = Property::eDeviceLocal;
  // Reading memory that is not cached takes longer than drawing.
  static constexpr std::initializer_list<vk::MemoryPropertyFlags> input{shared | local, shared},
      output{shared | Property::eHostCached, shared}, device{local};
  if (use == BufferUse::Input) return input;
  return use == BufferUse::Output ? output : device;
}

}  // namespace

std::optional<std::uint32_t> memoryType(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                        std::initializer_list<vk::MemoryPropertyFlags> choices) {
  for (const vk::MemoryPropertyFlags properties : choices)
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
      if ((allowed >> type & 1) && (memory.memoryTypes[type].propertyFlags & properties) == properties) return type;
  return std::nullopt;
}

VulkanBuffer makeBuffer(const VulkanContext& context, std::size_t size, BufferUse use) {
  using Usage = vk::BufferUsageFlagBits;
  vk::raii::Buffer buffer(
      context.device, vk::BufferCreateInfo{.size = std::max<std::size_t>(size, 4),  // an empty buffer is not allowed
                                           .usage = Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst});
  vk::raii::DeviceMemory memory = allocate(context, buffer.getMemoryRequirements(), memoryFor(use));
  buffer.bindMemory(*memory, 0);
  auto* const bytes = use == BufferUse::Device ? nullptr : static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
  return {std::move(memory), std::move(buffer), bytes};
}

VulkanBuffer makeStorageBuffer(const VulkanContext& context, std::span<const std::byte> content) {
  const std::uint32_t largest = context.physicalDevice.getProperties().limits.maxStorageBufferRange;
  if (content.size() > largest)
    throw raster::InputError("the draw list is larger than the buffers of the Vulkan device",
                             "use at most " + std::to_string(largest) + " bytes of corners or of index maps");
  VulkanBuffer buffer = makeBuffer(context, content.size(), BufferUse::Input);
  std::copy(content.begin(), content.end(), buffer.bytes);
  return buffer;
}

VulkanImage makeImage(const VulkanContext& context, vk::Format format, vk::ImageAspectFlags aspect,
                      vk::ImageUsageFlags usage, vk::Extent2D size, std::uint32_t layers) {
  vk::raii::Image image(context.device, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                                            .format = format,
                                                            .extent = {size.width, size.height, 1},
                                                            .mipLevels = 1,
                                                            .arrayLayers = layers,
                                                            .usage = usage});
  vk::raii::DeviceMemory memory =
      allocate(context, image.getMemoryRequirements(), {vk::MemoryPropertyFlagBits::eDeviceLocal});
  image.bindMemory(*memory, 0);
  const auto view = [&](vk::ImageViewType type, std::uint32_t first, std::uint32_t count) {
    return vk::raii::ImageView(
        context.device,
        vk::ImageViewCreateInfo{
            .image = *image, .viewType = type, .format = format, .subresourceRange = {aspect, 0, 1, first, count}});
  };
  std::vector<vk::raii::ImageView> each;
  for (std::uint32_t layer = 0; layer < layers; ++layer) each.push_back(view(vk::ImageViewType::e2D, layer, 1));
  vk::raii::ImageView all = view(vk::ImageViewType::e2DArray, 0, layers);
  return {std::move(memory), std::move(image), std::move(all), std::move(each)};
}

void awaitWrites(const vk::raii::CommandBuffer& commands) {
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
  const vk::MemoryBarrier2 barrier{.srcStageMask = Stage::eComputeShader | Stage::eTransfer,
                                   .srcAccessMask = Access::eShaderWrite | Access::eTransferWrite,
                                   .dstStageMask = Stage::eComputeShader,
                                   .dstAccessMask = Access::eShaderRead | Access::eShaderWrite};
  commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(barrier));
}

}  // namespace hemitex::reference
