#include "reference/devices/vulkan/vulkan_renderer.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/devices/batches.h"
#include "reference/devices/passed_samples.h"
#include "reference/devices/shader_inputs.h"
#include "reference/devices/viewport.h"
#include "reference/devices/vulkan/context.h"
#include "reference/devices/vulkan/pipeline.h"
#include "reference/devices/vulkan/render_targets.h"

namespace hemitex::reference {
namespace {

using raster::Face;
using raster::InputError;
using raster::ItemId;
using Layout = vk::ImageLayout;

InputError failure(const vk::SystemError& error) {
  return InputError(std::string("the Vulkan device fails: ") + error.what());
}

std::size_t bytesOf(const Face& face) {
  return sizeof(ItemId) * static_cast<std::size_t>(face.scissor.width) * static_cast<std::size_t>(face.scissor.height);
}

int largestViewport(const VulkanContext& context) {
  const auto& size = context.physicalDevice.getProperties().limits.maxViewportDimensions;
  return static_cast<int>(std::min(size[0], size[1]));
}

vk::raii::CommandPool makeCommandPool(const VulkanContext& context) {
  return {context.device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                    .queueFamilyIndex = context.queueFamily}};
}

vk::raii::CommandBuffer makeCommands(const VulkanContext& context, const vk::raii::CommandPool& pool) {
  const vk::CommandBufferAllocateInfo info{.commandPool = *pool, .commandBufferCount = 1};
  return std::move(vk::raii::CommandBuffers(context.device, info).front());
}

class VulkanRenderer final : public raster::ItemBufferRenderer {
 public:
  VulkanRenderer(const raster::DrawList& list, const std::string& name);
  void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  void makeRoom(std::span<const Face> faces);
  void recordDraws(const Face& face, const DeviceViewport& viewport, const VertexRuns& runs);
  void recordFace(const Face& face, const DeviceViewport& viewport, const VertexRuns& runs, std::size_t outputOffset);
  void submit();

  raster::DrawList list_;
  VulkanContext context_;
  int largestViewport_;
  VulkanPipeline pipeline_;
  vk::raii::CommandPool commandPool_;
  vk::raii::CommandBuffer commands_;
  std::optional<RenderTargets> targets_;
  std::optional<VulkanBuffer> output_;  ///< the item IDs of all faces, one after the other
  std::size_t outputSize_ = 0;
};

VulkanRenderer::VulkanRenderer(const raster::DrawList& list, const std::string& name)
    : list_(raster::assembled(list)),
      context_(openVulkanDevice(name)),
      largestViewport_(largestViewport(context_)),
      pipeline_(makePipeline(context_, list_)),
      commandPool_(makeCommandPool(context_)),
      commands_(makeCommands(context_, commandPool_)) {}

/// Enlarges the targets and the output where the faces need it.
void VulkanRenderer::makeRoom(std::span<const Face> faces) {
  vk::Extent2D size = targets_ ? targets_->size : vk::Extent2D{1, 1};
  std::size_t outputSize = 0;
  for (const Face& face : faces) {
    size.width = std::max(size.width, sizeOf(face).width);
    size.height = std::max(size.height, sizeOf(face).height);
    outputSize += bytesOf(face);
  }
  if (!targets_ || targets_->size != size) targets_ = makeRenderTargets(context_, pipeline_.formats, size);
  if (outputSize > outputSize_) {
    output_ = makeBuffer(context_, outputSize, vk::BufferUsageFlagBits::eTransferDst);
    outputSize_ = outputSize;
  }
}

void VulkanRenderer::recordDraws(const Face& face, const DeviceViewport& viewport, const VertexRuns& runs) {
  commands_.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_.pipeline);
  commands_.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipeline_.layout, 0, *pipeline_.descriptors, {});
  // Row 0 is at y/w = -1 in Vulkan as in the rules.
  commands_.setViewport(0, vk::Viewport{.x = static_cast<float>(viewport.x),
                                        .y = static_cast<float>(viewport.y),
                                        .width = static_cast<float>(viewport.columns),
                                        .height = static_cast<float>(viewport.rows),
                                        .minDepth = 0,
                                        .maxDepth = 1});
  commands_.setScissor(0, vk::Rect2D{{0, 0}, sizeOf(face)});
  // docs/item-buffers.md, "facing": front-facing if the area and the determinant differ in sign. Rows count downwards
  // in Vulkan, where a positive area of the rules is clockwise.
  const bool isPositive = raster::determinant(face) > 0, isTurned = list_.front == raster::Winding::Clockwise;
  commands_.setFrontFace(isPositive != isTurned ? vk::FrontFace::eCounterClockwise : vk::FrontFace::eClockwise);
  commands_.pushConstants<ShaderView>(*pipeline_.layout,
                                      vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
                                      shaderView(face, list_, viewport));
  const auto triangles = static_cast<std::uint32_t>(shaderTriangles(list_));
  for (std::size_t r = 0; r < runs.first.size(); ++r)
    commands_.draw(triangles * static_cast<std::uint32_t>(runs.count[r]), 1,
                   triangles * static_cast<std::uint32_t>(runs.first[r]), 0);
}

/// Draws a face, then copies its item IDs to the output, row 0 first and without padding.
void VulkanRenderer::recordFace(const Face& face, const DeviceViewport& viewport, const VertexRuns& runs,
                                std::size_t outputOffset) {
  beginRendering(commands_, *targets_, face, list_);
  recordDraws(face, viewport, runs);
  commands_.endRendering();
  changeLayout(commands_, targets_->colour, vk::ImageAspectFlagBits::eColor, Layout::eColorAttachmentOptimal,
               Layout::eTransferSrcOptimal);
  const vk::BufferImageCopy copy{.bufferOffset = outputOffset,
                                 .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                 .imageExtent = {sizeOf(face).width, sizeOf(face).height, 1}};
  commands_.copyImageToBuffer(*targets_->colour.image, Layout::eTransferSrcOptimal, *output_->buffer, copy);
}

/// Runs the recorded commands and waits until this program can read the output.
void VulkanRenderer::submit() {
  const vk::MemoryBarrier2 readable{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                    .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                    .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                    .dstAccessMask = vk::AccessFlagBits2::eHostRead};
  commands_.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(readable));
  commands_.end();
  context_.queue.submit(vk::SubmitInfo().setCommandBuffers(*commands_));
  context_.queue.waitIdle();
}

void VulkanRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) try {
  for (const Face& face : faces) raster::validate(face);
  std::vector<DeviceViewport> viewports;
  for (const Face& face : faces) viewports.push_back(viewportOf(face, 8, largestViewport_, "Vulkan"));
  buffers.resize(faces.size());
  if (faces.empty()) return;

  // Each corner has the number of its draw, so all draws are one batch.
  const auto batches = batchesOf(list_, skipped, [](const raster::Draw&, const raster::Draw&) { return true; });
  const VertexRuns runs = batches.empty() ? VertexRuns{} : batches.front().runs;
  makeRoom(faces);
  commands_.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  std::size_t offset = 0;
  for (std::size_t f = 0; f < faces.size(); offset += bytesOf(faces[f]), ++f)
    recordFace(faces[f], viewports[f], runs, offset);
  submit();
  const std::byte* ids = output_->bytes;
  for (std::size_t f = 0; f < faces.size(); ids += bytesOf(faces[f]), ++f) {
    buffers[f].resize(faces[f].scissor);
    std::memcpy(buffers[f].ids.data(), ids, bytesOf(faces[f]));
    if (pipeline_.formats.areCounts()) readCounts(buffers[f]);
  }
  raster::parallelFor(faces.size(), drawn);
} catch (const vk::SystemError& error) {
  throw failure(error);
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list,
                                                               const std::string& name) try {
  raster::validate(list);
  return std::make_unique<VulkanRenderer>(list, name);
} catch (const vk::SystemError& error) {
  throw failure(error);
}

std::string vulkanDeviceName(const std::string& name) { return nameOf(openVulkanDevice(name)); }

}  // namespace hemitex::reference
