/// The shaders, the draw list in their buffers (shader_inputs.h), and all states of drawing: item_ids.vert moves
/// corners to clip space, item_ids.frag computes depth and item ID.
#pragma once

#include <array>

#include "raster/interface/draw_list.h"
#include "reference/devices/vulkan/descriptors.h"
#include "reference/devices/vulkan/render_targets.h"

namespace hemitex::reference {

/// Corners, draws and texels of an assembled list.
using DrawArrays = std::array<VulkanBuffer, 3>;
/// Throws InputError if one is larger than the buffers of the device.
DrawArrays uploadDrawList(const VulkanContext& context, const raster::DrawList& list);

struct VulkanPipeline {
  TargetFormats formats;
  VulkanDescriptors descriptors;    ///< of the arrays
  vk::raii::PipelineLayout layout;  ///< the arrays, and a ShaderView as push constants
  vk::raii::Pipeline pipeline;      ///< the front face, the viewport and the scissor are set per view
};

/// Throws InputError if the device has no targets of the depths or counts of the list.
VulkanPipeline makePipeline(const VulkanContext& context, const raster::DrawList& list, const DrawArrays& arrays);

}  // namespace hemitex::reference
