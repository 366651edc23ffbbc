#include "reference/devices/vulkan/face_drawing.h"

#include <algorithm>

#include "reference/devices/batches.h"
#include "reference/devices/shader_inputs.h"
#include "reference/devices/viewport.h"

namespace hemitex::reference {
namespace {

using Layout = vk::ImageLayout;

int largestViewport(const VulkanContext& context) {
  const auto& size = context.physicalDevice.getProperties().limits.maxViewportDimensions;
  return static_cast<int>(std::min(size[0], size[1]));
}

vk::raii::CommandPool makeCommandPool(const VulkanContext& context) {
  return {context.device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                    .queueFamilyIndex = context.queueFamily}};
}

void recordDraws(const vk::raii::CommandBuffer& commands, const FaceDrawing& drawing, const raster::Face& face,
                 const VertexRuns& runs) {
  const DeviceViewport viewport = viewportOf(face, 8, largestViewport(drawing.context), "Vulkan");
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *drawing.graphics->pipeline);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *drawing.graphics->layout, 0,
                              *drawing.graphics->descriptors.set, {});
  // Row 0 is at y/w = -1 in Vulkan as in the rules.
  commands.setViewport(0, vk::Viewport{.x = static_cast<float>(viewport.x),
                                       .y = static_cast<float>(viewport.y),
                                       .width = static_cast<float>(viewport.columns),
                                       .height = static_cast<float>(viewport.rows),
                                       .minDepth = 0,
                                       .maxDepth = 1});
  commands.setScissor(0, vk::Rect2D{{0, 0}, sizeOf(face)});
  // docs/item-buffers.md, "facing": front-facing if the area and the determinant differ in sign. Rows count downwards
  // in Vulkan, where a positive area of the rules is clockwise.
  const bool isPositive = raster::determinant(face) > 0, isTurned = drawing.list.front == raster::Winding::Clockwise;
  commands.setFrontFace(isPositive != isTurned ? vk::FrontFace::eCounterClockwise : vk::FrontFace::eClockwise);
  commands.pushConstants<ShaderView>(*drawing.graphics->layout,
                                     vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
                                     shaderView(face, drawing.list, viewport));
  const auto triangles = static_cast<std::uint32_t>(shaderTriangles(drawing.list));
  for (std::size_t r = 0; r < runs.first.size(); ++r)
    commands.draw(triangles * static_cast<std::uint32_t>(runs.count[r]), 1,
                  triangles * static_cast<std::uint32_t>(runs.first[r]), 0);
}

/// The vertices without the skipped triangles.
VertexRuns runsWithout(const FaceDrawing& drawing, std::span<const std::uint32_t> skipped) {
  // Each corner has the number of its draw, so all draws are one batch.
  const auto batches = batchesOf(drawing.list, skipped, [](const raster::Draw&, const raster::Draw&) { return true; });
  return batches.empty() ? VertexRuns{} : batches.front().runs;
}

void recordViews(const vk::raii::CommandBuffer& commands, const FaceDrawing& drawing, const RenderTargets& targets,
                 std::span<const DrawnView> views) {
  std::uint32_t layer = 0;
  for (const DrawnView& view : views) {
    const VertexRuns runs = runsWithout(drawing, view.skipped);
    for (const raster::Face& face : view.faces) {
      beginRendering(commands, targets, layer++, face, drawing.list);
      recordDraws(commands, drawing, face, runs);
      commands.endRendering();
    }
  }
}

}  // namespace

FaceDrawing makeFaceDrawing(const raster::DrawList& list, VulkanPath path, const std::string& name) {
  raster::DrawList drawn = raster::assembled(list);
  VulkanContext context = openVulkanDevice(name);
  DrawArrays arrays = uploadDrawList(context, drawn);
  std::optional<VulkanPipeline> graphics;
  std::optional<TilePipeline> tiles;
  if (path == VulkanPath::Graphics)
    graphics = makePipeline(context, drawn, arrays);
  else
    tiles = makeTilePipeline(context, drawn);
  vk::raii::CommandPool pool = makeCommandPool(context);
  return {std::move(drawn),    std::move(context), std::move(arrays),
          std::move(graphics), std::move(tiles),   std::move(pool)};
}

vk::raii::CommandBuffer makeCommands(const FaceDrawing& drawing) {
  const vk::CommandBufferAllocateInfo info{.commandPool = *drawing.commandPool, .commandBufferCount = 1};
  return std::move(vk::raii::CommandBuffers(drawing.context.device, info).front());
}

Canvas makeCanvas(const FaceDrawing& drawing, vk::Extent2D size, std::size_t faces, std::size_t views) {
  const auto layers = static_cast<std::uint32_t>(faces);
  RenderTargets targets = drawing.tiles ? makeStoredTargets(drawing.context, size, layers)
                                        : makeRenderTargets(drawing.context, drawing.graphics->formats, size, layers);
  std::optional<TileBuffers> tiles;
  if (drawing.tiles)
    tiles = makeTileBuffers(drawing.context, *drawing.tiles, drawing.arrays, targets.colour, faces, views);
  return {std::move(targets), views, std::move(tiles)};
}

void record(const vk::raii::CommandBuffer& commands, const FaceDrawing& drawing, const Canvas& canvas,
            std::span<const DrawnView> views, Layout after) {
  dropContent(commands, canvas.targets);
  if (drawing.tiles)
    recordTiles(commands, *drawing.tiles, *canvas.tiles, drawing.list, views);
  else
    recordViews(commands, drawing, canvas.targets, views);
  changeLayout(commands, canvas.targets.colour, vk::ImageAspectFlagBits::eColor, layoutOf(canvas.targets), after);
}

std::size_t facesAtOnce(const FaceDrawing& drawing, vk::Extent2D size) {
  constexpr std::size_t pixels = std::size_t{1} << 25, bytesOfPieces = std::size_t{1} << 29;
  const vk::PhysicalDeviceLimits limits = drawing.context.physicalDevice.getProperties().limits;
  std::size_t layers = limits.maxImageArrayLayers;
  if (drawing.tiles)
    layers = std::min(layers, facesWithPieces(drawing.tiles->triangles,
                                              std::min<std::size_t>(bytesOfPieces, limits.maxStorageBufferRange)));
  return std::max<std::size_t>(1, std::min(layers, pixels / (std::size_t{size.width} * size.height)));
}

vk::Extent2D sizeOf(std::span<const raster::Face> faces) {
  vk::Extent2D size{1, 1};
  for (const raster::Face& face : faces)
    size = vk::Extent2D{std::max(size.width, sizeOf(face).width), std::max(size.height, sizeOf(face).height)};
  return size;
}

void submit(const FaceDrawing& drawing, const vk::raii::CommandBuffer& commands, vk::Fence done) {
  const vk::MemoryBarrier2 readable{
      .srcStageMask = vk::PipelineStageFlagBits2::eCopy | vk::PipelineStageFlagBits2::eComputeShader,
      .srcAccessMask = vk::AccessFlagBits2::eTransferWrite | vk::AccessFlagBits2::eShaderWrite,
      .dstStageMask = vk::PipelineStageFlagBits2::eHost,
      .dstAccessMask = vk::AccessFlagBits2::eHostRead};
  commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(readable));
  commands.end();
  drawing.context.queue.submit(vk::SubmitInfo().setCommandBuffers(*commands), done);
}

raster::InputError failureOf(const vk::SystemError& error) {
  return raster::InputError(std::string("the Vulkan device fails: ") + error.what());
}

}  // namespace hemitex::reference
