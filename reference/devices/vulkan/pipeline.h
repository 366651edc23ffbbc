/// The shaders, the draw list in their buffers (shader_inputs.h), and all states of drawing: item_ids.vert moves
/// corners to clip space, item_ids.frag computes depth and item ID.
#pragma once

#include <array>

#include "raster/interface/draw_list.h"
#include "reference/devices/vulkan/memory.h"

namespace hemitex::reference {

struct VulkanPipeline {
  static constexpr vk::Format colourFormat = vk::Format::eR32Uint;
  static constexpr vk::Format depthFormat = vk::Format::eD32Sfloat;

  std::array<VulkanBuffer, 3> arrays;  ///< corners, draws, texels
  vk::raii::DescriptorSetLayout buffers;
  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet descriptors;  ///< of the arrays, in the pool
  vk::raii::PipelineLayout layout;      ///< the buffers, and a ShaderView as push constants
  vk::raii::Pipeline pipeline;          ///< the front face, the viewport and the scissor are set per view
};

/// Throws InputError if an array is larger than the buffers of the device.
VulkanPipeline makePipeline(const VulkanContext& context, const raster::DrawList& list);

}  // namespace hemitex::reference
