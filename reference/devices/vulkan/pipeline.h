/// The shaders, the draw list in their buffers (shader_inputs.h), and all states of drawing: item_ids.vert moves
/// corners to clip space, item_ids.frag computes depth and item ID.
#pragma once

#include <array>

#include "raster/interface/draw_list.h"
#include "reference/devices/vulkan/render_targets.h"

namespace hemitex::reference {

struct VulkanPipeline {
  TargetFormats formats;
  std::array<VulkanBuffer, 3> arrays;  ///< corners, draws, texels
  vk::raii::DescriptorSetLayout buffers;
  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet descriptors;  ///< of the arrays, in the pool
  vk::raii::PipelineLayout layout;      ///< the buffers, and a ShaderView as push constants
  vk::raii::Pipeline pipeline;          ///< the front face, the viewport and the scissor are set per view
};

/// Throws InputError if an array of the assembled list is larger than the buffers of the device, or if the device has
/// no targets of its depths or counts.
VulkanPipeline makePipeline(const VulkanContext& context, const raster::DrawList& list);

}  // namespace hemitex::reference
