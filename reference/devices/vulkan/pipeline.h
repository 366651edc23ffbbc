/// The shaders and all states of drawing: item_ids.vert moves corners to clip space, item_ids.frag computes depth and
/// item ID.
#pragma once

#include "raster/interface/item_id.h"
#include "reference/devices/vulkan/context.h"

namespace hemitex::reference {

struct VulkanPipeline {
  static constexpr vk::Format colourFormat = vk::Format::eR32Uint;
  static constexpr vk::Format depthFormat = vk::Format::eD32Sfloat;

  vk::raii::DescriptorSetLayout buffers;  ///< three storage buffers: corners, draws, texels
  vk::raii::PipelineLayout layout;        ///< the buffers, and a ShaderView as push constants
  vk::raii::Pipeline pipeline;            ///< the front face, the viewport and the scissor are set per view
};

VulkanPipeline makePipeline(const VulkanContext& context);

}  // namespace hemitex::reference
