#include "reference/devices/vulkan/pipeline.h"

#include <span>

#include "raster/interface/depth_test.h"
#include "reference/devices/shader_inputs.h"

// SPIR-V: CMake compiles the shaders to these arrays of integers.
#include <item_ids_fragment.h>
#include <item_ids_vertex.h>

namespace hemitex::reference {
namespace {

using Stage = vk::ShaderStageFlagBits;

std::array<VulkanBuffer, 3> uploadDrawList(const VulkanContext& context, const raster::DrawList& list) {
  const auto upload = [&](const auto& array) { return makeStorageBuffer(context, std::as_bytes(std::span(array))); };
  return {upload(shaderCorners(list)), upload(shaderDraws(list)), upload(shaderTexels(list))};
}

vk::raii::DescriptorSetLayout makeBufferLayout(const VulkanContext& context) {
  std::array<vk::DescriptorSetLayoutBinding, 3> bindings;
  for (std::uint32_t b = 0; b < bindings.size(); ++b)
    bindings[b] = {.binding = b,
                   .descriptorType = vk::DescriptorType::eStorageBuffer,
                   .descriptorCount = 1,
                   .stageFlags = Stage::eVertex | Stage::eFragment};
  return {context.device, vk::DescriptorSetLayoutCreateInfo().setBindings(bindings)};
}

vk::raii::DescriptorPool makeDescriptorPool(const VulkanContext& context) {
  const vk::DescriptorPoolSize buffers{.type = vk::DescriptorType::eStorageBuffer, .descriptorCount = 3};
  const vk::DescriptorPoolCreateInfo info{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1};
  return {context.device, vk::DescriptorPoolCreateInfo(info).setPoolSizes(buffers)};
}

/// Tells the shaders where their three buffers are.
vk::raii::DescriptorSet makeDescriptors(const VulkanContext& context, const vk::raii::DescriptorPool& pool,
                                        const vk::raii::DescriptorSetLayout& layout,
                                        const std::array<VulkanBuffer, 3>& arrays) {
  const auto info = vk::DescriptorSetAllocateInfo{.descriptorPool = *pool}.setSetLayouts(*layout);
  vk::raii::DescriptorSet set = std::move(vk::raii::DescriptorSets(context.device, info).front());
  for (std::uint32_t b = 0; b < arrays.size(); ++b) {
    const vk::DescriptorBufferInfo whole{.buffer = *arrays[b].buffer, .range = VK_WHOLE_SIZE};
    vk::WriteDescriptorSet write{.dstSet = *set, .dstBinding = b, .descriptorType = vk::DescriptorType::eStorageBuffer};
    context.device.updateDescriptorSets(write.setBufferInfo(whole), {});
  }
  return set;
}

vk::raii::PipelineLayout makeLayout(const VulkanContext& context, const vk::raii::DescriptorSetLayout& buffers) {
  const vk::PushConstantRange view{.stageFlags = Stage::eVertex | Stage::eFragment, .size = sizeof(ShaderView)};
  return {context.device, vk::PipelineLayoutCreateInfo().setSetLayouts(*buffers).setPushConstantRanges(view)};
}

vk::raii::ShaderModule makeShader(const VulkanContext& context, std::span<const std::uint32_t> code) {
  return {context.device, vk::ShaderModuleCreateInfo{.codeSize = code.size_bytes(), .pCode = code.data()}};
}

vk::CompareOp compareOf(raster::DepthTest test) {
  const bool keepsLast = raster::keepsLast(test);
  if (raster::keepsFarther(test)) return keepsLast ? vk::CompareOp::eGreaterOrEqual : vk::CompareOp::eGreater;
  return keepsLast ? vk::CompareOp::eLessOrEqual : vk::CompareOp::eLess;
}

vk::raii::Pipeline makeGraphicsPipeline(const VulkanContext& context, const vk::raii::PipelineLayout& layout,
                                        const TargetFormats& formats, raster::DepthTest test) {
  const vk::raii::ShaderModule vertex = makeShader(context, itemIdsVertex),
                               fragment = makeShader(context, itemIdsFragment);
  const std::array<vk::PipelineShaderStageCreateInfo, 2> stages{
      {{.stage = Stage::eVertex, .module = *vertex, .pName = "main"},
       {.stage = Stage::eFragment, .module = *fragment, .pName = "main"}}};

  // The vertex shader reads corners from a buffer, so there are no vertex attributes.
  const vk::PipelineVertexInputStateCreateInfo noAttributes;
  const vk::PipelineInputAssemblyStateCreateInfo triangles{.topology = vk::PrimitiveTopology::eTriangleList};
  const vk::PipelineViewportStateCreateInfo oneViewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo bothFacings{.cullMode = vk::CullModeFlagBits::eNone, .lineWidth = 1};
  const vk::PipelineMultisampleStateCreateInfo oneSample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
  const vk::PipelineDepthStencilStateCreateInfo depthTest{
      .depthTestEnable = true, .depthWriteEnable = true, .depthCompareOp = compareOf(test)};
  const bool areCounts = formats.areCounts();
  const vk::PipelineColorBlendAttachmentState output{.blendEnable = areCounts,
                                                     .srcColorBlendFactor = vk::BlendFactor::eOne,
                                                     .dstColorBlendFactor = vk::BlendFactor::eOne,
                                                     .colorWriteMask = vk::ColorComponentFlagBits::eR};
  const std::array<vk::PipelineColorBlendAttachmentState, 2> outputs{output, output};
  const std::array<vk::Format, 2> second{vk::Format::eUndefined, formats.colour};
  vk::PipelineColorBlendStateCreateInfo blend;
  vk::PipelineRenderingCreateInfo targets{.depthAttachmentFormat = formats.depth};
  areCounts ? blend.setAttachments(outputs) : blend.setAttachments(output);
  areCounts ? targets.setColorAttachmentFormats(second) : targets.setColorAttachmentFormats(formats.colour);
  constexpr std::array<vk::DynamicState, 3> perView{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                                    vk::DynamicState::eFrontFace};
  const auto dynamic = vk::PipelineDynamicStateCreateInfo().setDynamicStates(perView);
  return {context.device, nullptr,
          vk::GraphicsPipelineCreateInfo{.pNext = &targets,
                                         .pVertexInputState = &noAttributes,
                                         .pInputAssemblyState = &triangles,
                                         .pViewportState = &oneViewport,
                                         .pRasterizationState = &bothFacings,
                                         .pMultisampleState = &oneSample,
                                         .pDepthStencilState = &depthTest,
                                         .pColorBlendState = &blend,
                                         .pDynamicState = &dynamic,
                                         .layout = *layout}
              .setStages(stages)};
}

}  // namespace

VulkanPipeline makePipeline(const VulkanContext& context, const raster::DrawList& list) {
  const TargetFormats formats = targetFormats(context, list);
  std::array<VulkanBuffer, 3> arrays = uploadDrawList(context, list);
  vk::raii::DescriptorSetLayout buffers = makeBufferLayout(context);
  vk::raii::DescriptorPool pool = makeDescriptorPool(context);
  vk::raii::DescriptorSet descriptors = makeDescriptors(context, pool, buffers, arrays);
  vk::raii::PipelineLayout layout = makeLayout(context, buffers);
  vk::raii::Pipeline pipeline = makeGraphicsPipeline(context, layout, formats, list.depthTest);
  return {formats,           std::move(arrays),  std::move(buffers), std::move(pool), std::move(descriptors),
          std::move(layout), std::move(pipeline)};
}

}  // namespace hemitex::reference
