#include "reference/devices/vulkan/render_targets.h"

#include <array>
#include <string>

#include "raster/base/input_error.h"
#include "raster/interface/depth_test.h"

namespace hemitex::reference {
namespace {

using Aspect = vk::ImageAspectFlagBits;
using Layout = vk::ImageLayout;

void requireFormat(const VulkanContext& context, vk::Format format, vk::FormatFeatureFlagBits use,
                   const std::string& what) {
  if (!(context.physicalDevice.getFormatProperties(format).optimalTilingFeatures & use))
    throw raster::InputError("the Vulkan device has no targets of " + what);
}

vk::Format depthFormat(raster::DepthPrecision precision) {
  if (precision == raster::DepthPrecision::Unorm16) return vk::Format::eD16Unorm;
  return precision == raster::DepthPrecision::Unorm24 ? vk::Format::eX8D24UnormPack32 : vk::Format::eD32Sfloat;
}

}  // namespace

TargetFormats targetFormats(const VulkanContext& context, const raster::DrawList& list) {
  using Feature = vk::FormatFeatureFlagBits;
  const bool areCounts = list.value == raster::PixelValue::PassedSamples;
  const TargetFormats formats{areCounts ? vk::Format::eR32Sfloat : vk::Format::eR32Uint,
                              depthFormat(list.depthPrecision)};
  if (areCounts) requireFormat(context, formats.colour, Feature::eColorAttachmentBlend, "counts of passed samples");
  requireFormat(context, formats.depth, Feature::eDepthStencilAttachment, "depths of this precision");
  return formats;
}

RenderTargets makeRenderTargets(const VulkanContext& context, const TargetFormats& formats, vk::Extent2D size,
                                std::uint32_t layers) {
  using Usage = vk::ImageUsageFlagBits;
  const vk::ImageUsageFlags drawn = Usage::eColorAttachment | Usage::eTransferSrc | Usage::eSampled;
  return {size, layers, makeImage(context, formats.colour, Aspect::eColor, drawn, size, layers),
          makeImage(context, formats.depth, Aspect::eDepth, Usage::eDepthStencilAttachment, size, layers)};
}

RenderTargets makeStoredTargets(const VulkanContext& context, vk::Extent2D size, std::uint32_t layers) {
  using Usage = vk::ImageUsageFlagBits;
  const vk::ImageUsageFlags stored = Usage::eStorage | Usage::eTransferSrc | Usage::eSampled;
  return {size, layers, makeImage(context, vk::Format::eR32Uint, Aspect::eColor, stored, size, layers), std::nullopt};
}

vk::Extent2D sizeOf(const raster::Face& face) {
  return {static_cast<std::uint32_t>(face.scissor.width), static_cast<std::uint32_t>(face.scissor.height)};
}

void changeLayout(const vk::raii::CommandBuffer& commands, const VulkanImage& image, Aspect aspect, Layout from,
                  Layout to) {
  using Access = vk::AccessFlagBits2;
  constexpr vk::PipelineStageFlags2 all = vk::PipelineStageFlagBits2::eAllCommands;
  constexpr vk::AccessFlags2 any = Access::eMemoryRead | Access::eMemoryWrite;
  const vk::ImageMemoryBarrier2 barrier{.srcStageMask = all,
                                        .srcAccessMask = any,
                                        .dstStageMask = all,
                                        .dstAccessMask = any,
                                        .oldLayout = from,
                                        .newLayout = to,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .image = *image.image,
                                        .subresourceRange = {aspect, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS}};
  commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barrier));
}

vk::ImageLayout layoutOf(const RenderTargets& targets) {
  return targets.depth ? Layout::eColorAttachmentOptimal : Layout::eGeneral;
}

void dropContent(const vk::raii::CommandBuffer& commands, const RenderTargets& targets) {
  changeLayout(commands, targets.colour, Aspect::eColor, Layout::eUndefined, layoutOf(targets));
  if (targets.depth)
    changeLayout(commands, *targets.depth, Aspect::eDepth, Layout::eUndefined, Layout::eDepthStencilAttachmentOptimal);
}

void beginRendering(const vk::raii::CommandBuffer& commands, const RenderTargets& targets, std::uint32_t layer,
                    const raster::Face& face, const raster::DrawList& list) {
  // A count of 0 has the bits of the number 0.
  const std::array<std::uint32_t, 4> cleared{raster::clearedValue(list), 0, 0, 0};
  const vk::RenderingAttachmentInfo colour{.imageView = *targets.colour.layers[layer],
                                           .imageLayout = Layout::eColorAttachmentOptimal,
                                           .loadOp = vk::AttachmentLoadOp::eClear,
                                           .storeOp = vk::AttachmentStoreOp::eStore,
                                           .clearValue = {vk::ClearColorValue(cleared)}};
  const vk::RenderingAttachmentInfo depth{
      .imageView = *targets.depth->layers[layer],
      .imageLayout = Layout::eDepthStencilAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eDontCare,
      .clearValue = {vk::ClearDepthStencilValue{raster::keepsFarther(list.depthTest) ? 0.0F : 1.0F, 0}}};
  const std::array<vk::RenderingAttachmentInfo, 2> second{vk::RenderingAttachmentInfo{}, colour};
  vk::RenderingInfo info{.renderArea = {{0, 0}, sizeOf(face)}, .layerCount = 1, .pDepthAttachment = &depth};
  const bool areCounts = list.value == raster::PixelValue::PassedSamples;
  commands.beginRendering(areCounts ? info.setColorAttachments(second) : info.setColorAttachments(colour));
}

}  // namespace hemitex::reference
