/// Descriptors: how shaders find their buffers and images, and the modules of shaders.
#pragma once

#include <span>

#include "reference/devices/vulkan/memory.h"

namespace hemitex::reference {

/// One set, with a resource per binding.
struct VulkanDescriptors {
  vk::raii::DescriptorSetLayout layout;
  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet set;  ///< in the pool
};

/// A set for these types of resources, bindings 0, 1, ..., in these stages.
VulkanDescriptors makeDescriptors(const VulkanContext& context, std::span<const vk::DescriptorType> types,
                                  vk::ShaderStageFlags stages);

/// Binds a whole storage buffer, or all layers of an image that shaders fetch texels from, or store them to.
void bind(const VulkanContext& context, const VulkanDescriptors& descriptors, std::uint32_t binding,
          const VulkanBuffer& buffer);
void bind(const VulkanContext& context, const VulkanDescriptors& descriptors, std::uint32_t binding,
          const VulkanImage& image, vk::DescriptorType type);

/// The layout of a pipeline with one set and push constants.
vk::raii::PipelineLayout makePipelineLayout(const VulkanContext& context, const VulkanDescriptors& descriptors,
                                            const vk::PushConstantRange& constants);

vk::raii::Pipeline makeComputePipeline(const VulkanContext& context, const vk::raii::PipelineLayout& layout,
                                       std::span<const std::uint32_t> code);

vk::raii::ShaderModule makeShader(const VulkanContext& context, std::span<const std::uint32_t> code);

}  // namespace hemitex::reference
