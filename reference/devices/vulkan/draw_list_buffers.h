/// The draw list in memory of the device (shader_inputs.h).
#pragma once

#include <array>

#include "raster/interface/draw_list.h"
#include "reference/devices/vulkan/memory.h"
#include "reference/devices/vulkan/pipeline.h"

namespace hemitex::reference {

struct DrawListBuffers {
  std::array<VulkanBuffer, 3> arrays;  ///< corners, draws, texels
  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet descriptors;  ///< of the arrays, in the pool
};

/// Throws InputError if an array is larger than the buffers of the device.
DrawListBuffers uploadDrawList(const VulkanContext& context, const VulkanPipeline& pipeline,
                               const raster::DrawList& list);

}  // namespace hemitex::reference
