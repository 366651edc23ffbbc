/// The images that a face is drawn into.
#pragma once

#include "raster/interface/face.h"
#include "reference/devices/vulkan/memory.h"

namespace hemitex::reference {

/// Item IDs and depths of one face at a time, at most of this size.
struct RenderTargets {
  vk::Extent2D size;
  VulkanImage colour, depth;
};

RenderTargets makeRenderTargets(const VulkanContext& context, vk::Extent2D size);

/// The size of a face's scissor rectangle.
vk::Extent2D sizeOf(const raster::Face& face);

/// Waits for all earlier commands, then changes the layout of an image. ImageLayout::eUndefined drops its content.
void changeLayout(const vk::raii::CommandBuffer& commands, const VulkanImage& image, vk::ImageAspectFlagBits aspect,
                  vk::ImageLayout from, vk::ImageLayout to);

/// Begins to render a face, with all item IDs `background` and all depths farthest.
void beginRendering(const vk::raii::CommandBuffer& commands, const RenderTargets& targets, const raster::Face& face,
                    raster::ItemId background);

}  // namespace hemitex::reference
