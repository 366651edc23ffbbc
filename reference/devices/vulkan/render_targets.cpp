#include "reference/devices/vulkan/render_targets.h"

#include <array>

#include "reference/devices/vulkan/pipeline.h"

namespace hemitex::reference {
namespace {

using Aspect = vk::ImageAspectFlagBits;
using Layout = vk::ImageLayout;

}  // namespace

RenderTargets makeRenderTargets(const VulkanContext& context, vk::Extent2D size) {
  using Usage = vk::ImageUsageFlagBits;
  return {size,
          makeImage(context, VulkanPipeline::colourFormat, Aspect::eColor,
                    Usage::eColorAttachment | Usage::eTransferSrc, size),
          makeImage(context, VulkanPipeline::depthFormat, Aspect::eDepth, Usage::eDepthStencilAttachment, size)};
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
                                        .subresourceRange = {aspect, 0, 1, 0, 1}};
  commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barrier));
}

void beginRendering(const vk::raii::CommandBuffer& commands, const RenderTargets& targets, const raster::Face& face,
                    raster::ItemId background) {
  const vk::RenderingAttachmentInfo colour{
      .imageView = *targets.colour.view,
      .imageLayout = Layout::eColorAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eStore,
      .clearValue = {vk::ClearColorValue(std::array<std::uint32_t, 4>{background, 0, 0, 0})}};
  const vk::RenderingAttachmentInfo depth{.imageView = *targets.depth.view,
                                          .imageLayout = Layout::eDepthStencilAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eDontCare,
                                          .clearValue = {vk::ClearDepthStencilValue{1, 0}}};
  changeLayout(commands, targets.colour, Aspect::eColor, Layout::eUndefined, colour.imageLayout);
  changeLayout(commands, targets.depth, Aspect::eDepth, Layout::eUndefined, depth.imageLayout);
  commands.beginRendering(
      vk::RenderingInfo{.renderArea = {{0, 0}, sizeOf(face)}, .layerCount = 1, .pDepthAttachment = &depth}
          .setColorAttachments(colour));
}

}  // namespace hemitex::reference
