/// The images that a face is drawn into.
#pragma once

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "reference/devices/vulkan/memory.h"

namespace hemitex::reference {

/// The formats of the pixels of a list and of its depths. Shaders write item IDs to the first colour, and counts, which
/// a blend unit adds (passed_samples.h), to the second one.
struct TargetFormats {
  vk::Format colour, depth;

  bool areCounts() const { return colour == vk::Format::eR32Sfloat; }
};

/// Throws InputError if the device does not have them.
TargetFormats targetFormats(const VulkanContext& context, const raster::DrawList& list);

/// Item IDs and depths of one face at a time, at most of this size.
struct RenderTargets {
  vk::Extent2D size;
  VulkanImage colour, depth;
};

RenderTargets makeRenderTargets(const VulkanContext& context, const TargetFormats& formats, vk::Extent2D size);

/// The size of a face's scissor rectangle.
vk::Extent2D sizeOf(const raster::Face& face);

/// Waits for all earlier commands, then changes the layout of an image. ImageLayout::eUndefined drops its content.
void changeLayout(const vk::raii::CommandBuffer& commands, const VulkanImage& image, vk::ImageAspectFlagBits aspect,
                  vk::ImageLayout from, vk::ImageLayout to);

/// Begins to render a face of the list, with all pixels cleared, and all depths to where any fragment passes.
void beginRendering(const vk::raii::CommandBuffer& commands, const RenderTargets& targets, const raster::Face& face,
                    const raster::DrawList& list);

}  // namespace hemitex::reference
