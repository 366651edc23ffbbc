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

DrawArrays uploadDrawList(const VulkanContext& context, const raster::DrawList& list) {
  const auto upload = [&](const auto& array) { return makeStorageBuffer(context, std::as_bytes(std::span(array))); };
  return {upload(shaderCorners(list)), upload(shaderDraws(list)), upload(shaderTexels(list))};
}

VulkanPipeline makePipeline(const VulkanContext& context, const raster::DrawList& list, const DrawArrays& arrays) {
  constexpr vk::ShaderStageFlags stages = Stage::eVertex | Stage::eFragment;
  const TargetFormats formats = targetFormats(context, list);
  std::array<vk::DescriptorType, 3> types;
  types.fill(vk::DescriptorType::eStorageBuffer);
  VulkanDescriptors descriptors = makeDescriptors(context, types, stages);
  for (std::uint32_t b = 0; b < arrays.size(); ++b) bind(context, descriptors, b, arrays[b]);
  vk::raii::PipelineLayout layout =
      makePipelineLayout(context, descriptors, {.stageFlags = stages, .size = sizeof(ShaderView)});
  vk::raii::Pipeline pipeline = makeGraphicsPipeline(context, layout, formats, list.depthTest);
  return {formats, std::move(descriptors), std::move(layout), std::move(pipeline)};
}

}  // namespace hemitex::reference
