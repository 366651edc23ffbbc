#include "reference/devices/vulkan/descriptors.h"

#include <map>
#include <vector>

namespace hemitex::reference {
namespace {

vk::raii::DescriptorPool makePool(const VulkanContext& context, std::span<const vk::DescriptorType> types) {
  std::map<vk::DescriptorType, std::uint32_t> counts;
  for (const vk::DescriptorType type : types) ++counts[type];
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const auto& [type, count] : counts) sizes.push_back({.type = type, .descriptorCount = count});
  const vk::DescriptorPoolCreateInfo info{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1};
  return {context.device, vk::DescriptorPoolCreateInfo(info).setPoolSizes(sizes)};
}

vk::WriteDescriptorSet writeOf(const VulkanDescriptors& descriptors, std::uint32_t binding, vk::DescriptorType type) {
  return {.dstSet = *descriptors.set, .dstBinding = binding, .descriptorCount = 1, .descriptorType = type};
}

}  // namespace

VulkanDescriptors makeDescriptors(const VulkanContext& context, std::span<const vk::DescriptorType> types,
                                  vk::ShaderStageFlags stages) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const vk::DescriptorType type : types)
    bindings.push_back({.binding = static_cast<std::uint32_t>(bindings.size()),
                        .descriptorType = type,
                        .descriptorCount = 1,
                        .stageFlags = stages});
  vk::raii::DescriptorSetLayout layout(context.device, vk::DescriptorSetLayoutCreateInfo().setBindings(bindings));
  vk::raii::DescriptorPool pool = makePool(context, types);
  const auto info = vk::DescriptorSetAllocateInfo{.descriptorPool = *pool}.setSetLayouts(*layout);
  vk::raii::DescriptorSet set = std::move(vk::raii::DescriptorSets(context.device, info).front());
  return {std::move(layout), std::move(pool), std::move(set)};
}

void bind(const VulkanContext& context, const VulkanDescriptors& descriptors, std::uint32_t binding,
          const VulkanBuffer& buffer) {
  const vk::DescriptorBufferInfo whole{.buffer = *buffer.buffer, .range = VK_WHOLE_SIZE};
  vk::WriteDescriptorSet write = writeOf(descriptors, binding, vk::DescriptorType::eStorageBuffer);
  context.device.updateDescriptorSets(write.setBufferInfo(whole), {});
}

void bind(const VulkanContext& context, const VulkanDescriptors& descriptors, std::uint32_t binding,
          const VulkanImage& image, vk::DescriptorType type) {
  const bool isRead = type == vk::DescriptorType::eSampledImage;
  const vk::DescriptorImageInfo all{
      .imageView = *image.view,
      .imageLayout = isRead ? vk::ImageLayout::eShaderReadOnlyOptimal : vk::ImageLayout::eGeneral};
  vk::WriteDescriptorSet write = writeOf(descriptors, binding, type);
  context.device.updateDescriptorSets(write.setImageInfo(all), {});
}

vk::raii::PipelineLayout makePipelineLayout(const VulkanContext& context, const VulkanDescriptors& descriptors,
                                            const vk::PushConstantRange& constants) {
  return {context.device,
          vk::PipelineLayoutCreateInfo().setSetLayouts(*descriptors.layout).setPushConstantRanges(constants)};
}

vk::raii::Pipeline makeComputePipeline(const VulkanContext& context, const vk::raii::PipelineLayout& layout,
                                       std::span<const std::uint32_t> code) {
  const vk::raii::ShaderModule shader = makeShader(context, code);
  return {context.device, nullptr,
          vk::ComputePipelineCreateInfo{
              .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *shader, .pName = "main"},
              .layout = *layout}};
}

vk::raii::ShaderModule makeShader(const VulkanContext& context, std::span<const std::uint32_t> code) {
  return {context.device, vk::ShaderModuleCreateInfo{.codeSize = code.size_bytes(), .pCode = code.data()}};
}

}  // namespace hemitex::reference
