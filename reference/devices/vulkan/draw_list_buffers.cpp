#include "reference/devices/vulkan/draw_list_buffers.h"

#include <span>

#include "reference/devices/shader_inputs.h"

namespace hemitex::reference {
namespace {

std::array<VulkanBuffer, 3> makeArrays(const VulkanContext& context, const raster::DrawList& list) {
  const auto upload = [&](const auto& array) { return makeStorageBuffer(context, std::as_bytes(std::span(array))); };
  return {upload(shaderCorners(list)), upload(shaderDraws(list)), upload(shaderTexels(list))};
}

vk::raii::DescriptorPool makeDescriptorPool(const VulkanContext& context) {
  const vk::DescriptorPoolSize buffers{.type = vk::DescriptorType::eStorageBuffer, .descriptorCount = 3};
  return {context.device, vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                       .maxSets = 1,
                                                       .poolSizeCount = 1,
                                                       .pPoolSizes = &buffers}};
}

/// Tells the shaders where their three buffers are.
vk::raii::DescriptorSet makeDescriptors(const VulkanContext& context, const vk::raii::DescriptorPool& pool,
                                        const VulkanPipeline& pipeline, const std::array<VulkanBuffer, 3>& arrays) {
  const vk::DescriptorSetAllocateInfo info{
      .descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*pipeline.buffers};
  vk::raii::DescriptorSet set = std::move(vk::raii::DescriptorSets(context.device, info).front());
  for (std::uint32_t b = 0; b < arrays.size(); ++b) {
    const vk::DescriptorBufferInfo whole{.buffer = *arrays[b].buffer, .range = VK_WHOLE_SIZE};
    const vk::WriteDescriptorSet write{.dstSet = *set,
                                       .dstBinding = b,
                                       .descriptorCount = 1,
                                       .descriptorType = vk::DescriptorType::eStorageBuffer,
                                       .pBufferInfo = &whole};
    context.device.updateDescriptorSets(write, {});
  }
  return set;
}

}  // namespace

DrawListBuffers uploadDrawList(const VulkanContext& context, const VulkanPipeline& pipeline,
                               const raster::DrawList& list) {
  std::array<VulkanBuffer, 3> arrays = makeArrays(context, list);
  vk::raii::DescriptorPool pool = makeDescriptorPool(context);
  vk::raii::DescriptorSet descriptors = makeDescriptors(context, pool, pipeline, arrays);
  return {std::move(arrays), std::move(pool), std::move(descriptors)};
}

}  // namespace hemitex::reference
