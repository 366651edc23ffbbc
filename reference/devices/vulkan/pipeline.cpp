#include "reference/devices/vulkan/pipeline.h"

#include <array>
#include <span>

#include "reference/devices/shader_inputs.h"

// SPIR-V: CMake compiles the shaders to these arrays of integers.
#include <item_ids_fragment.h>
#include <item_ids_vertex.h>

namespace hemitex::reference {
namespace {

using Stage = vk::ShaderStageFlagBits;

vk::raii::DescriptorSetLayout makeBufferLayout(const VulkanContext& context) {
  std::array<vk::DescriptorSetLayoutBinding, 3> bindings;
  for (std::uint32_t b = 0; b < bindings.size(); ++b)
    bindings[b] = {.binding = b,
                   .descriptorType = vk::DescriptorType::eStorageBuffer,
                   .descriptorCount = 1,
                   .stageFlags = Stage::eVertex | Stage::eFragment};
  return {context.device, vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                            .pBindings = bindings.data()}};
}

vk::raii::PipelineLayout makeLayout(const VulkanContext& context, const vk::raii::DescriptorSetLayout& buffers) {
  const vk::PushConstantRange view{.stageFlags = Stage::eVertex | Stage::eFragment, .size = sizeof(ShaderView)};
  return {
      context.device,
      vk::PipelineLayoutCreateInfo{
          .setLayoutCount = 1, .pSetLayouts = &*buffers, .pushConstantRangeCount = 1, .pPushConstantRanges = &view}};
}

vk::raii::ShaderModule makeShader(const VulkanContext& context, std::span<const std::uint32_t> code) {
  return {context.device, vk::ShaderModuleCreateInfo{.codeSize = code.size_bytes(), .pCode = code.data()}};
}

vk::raii::Pipeline makeGraphicsPipeline(const VulkanContext& context, const vk::raii::PipelineLayout& layout) {
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
  const vk::PipelineDepthStencilStateCreateInfo nearer{
      .depthTestEnable = true, .depthWriteEnable = true, .depthCompareOp = vk::CompareOp::eLess};
  const vk::PipelineColorBlendAttachmentState unblended{.colorWriteMask = vk::ColorComponentFlagBits::eR};
  const vk::PipelineColorBlendStateCreateInfo replace{.attachmentCount = 1, .pAttachments = &unblended};
  constexpr std::array<vk::DynamicState, 3> perView{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                                    vk::DynamicState::eFrontFace};
  const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = perView.size(),
                                                   .pDynamicStates = perView.data()};
  const vk::PipelineRenderingCreateInfo targets{.colorAttachmentCount = 1,
                                                .pColorAttachmentFormats = &VulkanPipeline::colourFormat,
                                                .depthAttachmentFormat = VulkanPipeline::depthFormat};
  return {context.device, nullptr,
          vk::GraphicsPipelineCreateInfo{.pNext = &targets,
                                         .stageCount = stages.size(),
                                         .pStages = stages.data(),
                                         .pVertexInputState = &noAttributes,
                                         .pInputAssemblyState = &triangles,
                                         .pViewportState = &oneViewport,
                                         .pRasterizationState = &bothFacings,
                                         .pMultisampleState = &oneSample,
                                         .pDepthStencilState = &nearer,
                                         .pColorBlendState = &replace,
                                         .pDynamicState = &dynamic,
                                         .layout = *layout}};
}

}  // namespace

VulkanPipeline makePipeline(const VulkanContext& context) {
  vk::raii::DescriptorSetLayout buffers = makeBufferLayout(context);
  vk::raii::PipelineLayout layout = makeLayout(context, buffers);
  vk::raii::Pipeline pipeline = makeGraphicsPipeline(context, layout);
  return {std::move(buffers), std::move(layout), std::move(pipeline)};
}

}  // namespace hemitex::reference
