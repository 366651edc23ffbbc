/// The images that faces are drawn into, one layer per face.
#pragma once

#include <optional>

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

/// Item IDs and depths of faces at most of this size; compute shaders need no depths.
struct RenderTargets {
  vk::Extent2D size;
  std::uint32_t layers;
  VulkanImage colour;
  std::optional<VulkanImage> depth;
};

RenderTargets makeRenderTargets(const VulkanContext& context, const TargetFormats& formats, vk::Extent2D size,
                                std::uint32_t layers);
/// Item IDs that a compute shader stores.
RenderTargets makeStoredTargets(const VulkanContext& context, vk::Extent2D size, std::uint32_t layers);

/// The size of a face's scissor rectangle.
vk::Extent2D sizeOf(const raster::Face& face);

/// Waits for all earlier commands, then changes the layout of an image. ImageLayout::eUndefined drops its content.
void changeLayout(const vk::raii::CommandBuffer& commands, const VulkanImage& image, vk::ImageAspectFlagBits aspect,
                  vk::ImageLayout from, vk::ImageLayout to);

/// The layout of the item IDs while they are drawn.
vk::ImageLayout layoutOf(const RenderTargets& targets);

/// Makes all layers ready to be drawn into.
void dropContent(const vk::raii::CommandBuffer& commands, const RenderTargets& targets);

/// Begins to render a face of the list into a layer, with all pixels cleared, and all depths to where any fragment
/// passes.
void beginRendering(const vk::raii::CommandBuffer& commands, const RenderTargets& targets, std::uint32_t layer,
                    const raster::Face& face, const raster::DrawList& list);

}  // namespace hemitex::reference
