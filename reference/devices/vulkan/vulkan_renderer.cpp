#include "reference/devices/vulkan/vulkan_renderer.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/devices/batches.h"
#include "reference/devices/shader_inputs.h"
#include "reference/devices/vulkan/context.h"
#include "reference/devices/vulkan/draw_list_buffers.h"
#include "reference/devices/vulkan/memory.h"
#include "reference/devices/vulkan/pipeline.h"
#include "reference/devices/vulkan/render_targets.h"

namespace hemitex::reference {
namespace {

using raster::Face;
using raster::InputError;
using raster::ItemId;
using Layout = vk::ImageLayout;

VulkanContext openDevice() {
  std::optional<VulkanContext> context = openVulkanDevice();
  if (!context)
    throw InputError("no Vulkan device with the required features answers",
                     "install a driver of Vulkan 1.3 with double precision in shaders; Mesa's lavapipe needs no "
                     "graphics card");
  return std::move(*context);
}

InputError failure(const vk::SystemError& error) {
  return InputError(std::string("the Vulkan device fails: ") + error.what());
}

std::size_t bytesOf(const Face& face) {
  return sizeof(ItemId) * static_cast<std::size_t>(face.scissor.width) * static_cast<std::size_t>(face.scissor.height);
}

/// The width of the viewport in faces. The device clips triangles at the sides of its viewport. So the viewport is as
/// wide as the guard band of the rules, or as the device allows.
int viewportWidth(const Face& face, const vk::PhysicalDeviceLimits& limits) {
  const auto allows = [&](int width) {
    const int size = width * face.resolution, beside = (size - face.resolution) / 2;
    return static_cast<std::uint32_t>(size) <=
               std::min(limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]) &&
           static_cast<float>(-beside - face.resolution) >= limits.viewportBoundsRange[0] &&
           static_cast<float>(beside + face.resolution) <= limits.viewportBoundsRange[1];
  };
  int width = 8;
  while (width > 1 && !allows(width)) width /= 2;
  return width;
}

/// The framebuffer shows the scissor rectangle of the face. Row 0 is at y/w = -1 in Vulkan as in the rules.
vk::Viewport viewportOf(const Face& face, int width) {
  const int beside = (width - 1) * face.resolution / 2;
  const auto size = static_cast<float>(width * face.resolution);
  return {.x = static_cast<float>(-beside - face.scissor.column),
          .y = static_cast<float>(-beside - face.scissor.row),
          .width = size,
          .height = size,
          .minDepth = 0,
          .maxDepth = 1};
}

vk::raii::CommandPool makeCommandPool(const VulkanContext& context) {
  return {context.device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                    .queueFamilyIndex = context.queueFamily}};
}

vk::raii::CommandBuffer makeCommands(const VulkanContext& context, const vk::raii::CommandPool& pool) {
  const vk::CommandBufferAllocateInfo info{.commandPool = *pool, .commandBufferCount = 1};
  return std::move(vk::raii::CommandBuffers(context.device, info).front());
}

}  // namespace

class VulkanRenderer::Implementation {
 public:
  explicit Implementation(const raster::DrawList& list);
  void draw(std::span<const Face> faces, const VertexRuns& runs, std::vector<raster::ItemBuffer>& buffers);
  VertexRuns runsWithout(std::span<const std::uint32_t> skipped) const;

 private:
  void makeRoom(std::span<const Face> faces);
  void recordDraws(const Face& face, const VertexRuns& runs);
  void recordFace(const Face& face, const VertexRuns& runs, std::size_t outputOffset);
  void submit();

  raster::DrawList list_;
  VulkanContext context_;
  vk::PhysicalDeviceLimits limits_;
  VulkanPipeline pipeline_;
  DrawListBuffers drawList_;
  vk::raii::CommandPool commandPool_;
  vk::raii::CommandBuffer commands_;
  std::optional<RenderTargets> targets_;
  std::optional<VulkanBuffer> output_;  ///< the item IDs of all faces, one after the other
  std::size_t outputSize_ = 0;
};

VulkanRenderer::Implementation::Implementation(const raster::DrawList& list)
    : list_(list),
      context_(openDevice()),
      limits_(context_.physicalDevice.getProperties().limits),
      pipeline_(makePipeline(context_)),
      drawList_(uploadDrawList(context_, pipeline_, list)),
      commandPool_(makeCommandPool(context_)),
      commands_(makeCommands(context_, commandPool_)) {}

/// Each corner has the number of its draw, so all draws are one batch.
VertexRuns VulkanRenderer::Implementation::runsWithout(std::span<const std::uint32_t> skipped) const {
  const auto batches = batchesOf(list_, skipped, [](const raster::Draw&, const raster::Draw&) { return true; });
  return batches.empty() ? VertexRuns{} : batches.front().runs;
}

/// Enlarges the targets and the output where the faces need it.
void VulkanRenderer::Implementation::makeRoom(std::span<const Face> faces) {
  vk::Extent2D size = targets_ ? targets_->size : vk::Extent2D{1, 1};
  std::size_t outputSize = 0;
  for (const Face& face : faces) {
    size.width = std::max(size.width, sizeOf(face).width);
    size.height = std::max(size.height, sizeOf(face).height);
    outputSize += bytesOf(face);
  }
  if (!targets_ || targets_->size != size) targets_ = makeRenderTargets(context_, size);
  if (outputSize > outputSize_) {
    output_ = makeBuffer(context_, outputSize, vk::BufferUsageFlagBits::eTransferDst);
    outputSize_ = outputSize;
  }
}

void VulkanRenderer::Implementation::recordDraws(const Face& face, const VertexRuns& runs) {
  const int width = viewportWidth(face, limits_);
  commands_.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_.pipeline);
  commands_.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipeline_.layout, 0, *drawList_.descriptors, {});
  commands_.setViewport(0, viewportOf(face, width));
  commands_.setScissor(0, vk::Rect2D{{0, 0}, sizeOf(face)});
  // docs/item-buffers.md, "facing": front-facing if the area and the determinant differ in sign. Rows count downwards
  // in Vulkan, where a positive area of the rules is clockwise.
  commands_.setFrontFace(raster::determinant(face) > 0 ? vk::FrontFace::eCounterClockwise : vk::FrontFace::eClockwise);
  commands_.pushConstants<ShaderView>(*pipeline_.layout,
                                      vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
                                      shaderView(face, list_, width));
  // The vertex shader makes two triangles of each.
  for (std::size_t r = 0; r < runs.first.size(); ++r)
    commands_.draw(2 * static_cast<std::uint32_t>(runs.count[r]), 1, 2 * static_cast<std::uint32_t>(runs.first[r]), 0);
}

/// Draws a face, then copies its item IDs to the output, row 0 first and without padding.
void VulkanRenderer::Implementation::recordFace(const Face& face, const VertexRuns& runs, std::size_t outputOffset) {
  beginRendering(commands_, *targets_, face, raster::backgroundId(list_.format));
  recordDraws(face, runs);
  commands_.endRendering();
  changeLayout(commands_, targets_->colour, vk::ImageAspectFlagBits::eColor, Layout::eColorAttachmentOptimal,
               Layout::eTransferSrcOptimal);
  const vk::BufferImageCopy copy{.bufferOffset = outputOffset,
                                 .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                 .imageExtent = {sizeOf(face).width, sizeOf(face).height, 1}};
  commands_.copyImageToBuffer(*targets_->colour.image, Layout::eTransferSrcOptimal, *output_->buffer, copy);
}

/// Runs the recorded commands and waits until this program can read the output.
void VulkanRenderer::Implementation::submit() {
  const vk::MemoryBarrier2 readable{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                    .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                    .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                    .dstAccessMask = vk::AccessFlagBits2::eHostRead};
  commands_.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &readable});
  commands_.end();
  context_.queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands_});
  context_.queue.waitIdle();
}

void VulkanRenderer::Implementation::draw(std::span<const Face> faces, const VertexRuns& runs,
                                          std::vector<raster::ItemBuffer>& buffers) {
  makeRoom(faces);
  commands_.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  std::size_t offset = 0;
  for (const Face& face : faces) {
    recordFace(face, runs, offset);
    offset += bytesOf(face);
  }
  submit();
  const std::byte* ids = output_->bytes;
  for (std::size_t f = 0; f < faces.size(); ids += bytesOf(faces[f]), ++f) {
    buffers[f].resize(faces[f].scissor);
    std::memcpy(buffers[f].ids.data(), ids, bytesOf(faces[f]));
  }
}

VulkanRenderer::VulkanRenderer(const raster::DrawList& list) {
  raster::validate(list);
  try {
    implementation_ = std::make_unique<Implementation>(list);
  } catch (const vk::SystemError& error) {
    throw failure(error);
  }
}

VulkanRenderer::~VulkanRenderer() = default;

void VulkanRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  for (const Face& face : faces) raster::validate(face);
  buffers.resize(faces.size());
  if (faces.empty()) return;
  try {
    implementation_->draw(faces, implementation_->runsWithout(skipped), buffers);
  } catch (const vk::SystemError& error) {
    throw failure(error);
  }
  raster::parallelFor(faces.size(), drawn);
}

}  // namespace hemitex::reference
