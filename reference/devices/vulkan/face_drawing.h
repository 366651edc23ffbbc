/// Draws faces of a draw list into the layers of render targets: what item buffers and sums of pixels share.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "raster/base/input_error.h"
#include "reference/devices/vulkan/context.h"
#include "reference/devices/vulkan/pipeline.h"
#include "reference/devices/vulkan/render_targets.h"
#include "reference/devices/vulkan/tile_drawing.h"
#include "reference/devices/vulkan/vulkan_path.h"

namespace hemitex::reference {

struct FaceDrawing {
  raster::DrawList list;  ///< assembled
  VulkanContext context;
  DrawArrays arrays;
  std::optional<VulkanPipeline> graphics;  ///< one of the two
  std::optional<TilePipeline> tiles;
  vk::raii::CommandPool commandPool;

  bool areCounts() const { return list.value == raster::PixelValue::PassedSamples; }
};

/// On the first device whose name contains `name`; throws as openVulkanDevice, makePipeline and makeTilePipeline.
FaceDrawing makeFaceDrawing(const raster::DrawList& list, VulkanPath path, const std::string& name);

vk::raii::CommandBuffer makeCommands(const FaceDrawing& drawing);

/// What faces are drawn into.
struct Canvas {
  RenderTargets targets;
  std::size_t views;
  std::optional<TileBuffers> tiles;
};

/// Room for faces of this size, of this number of views.
Canvas makeCanvas(const FaceDrawing& drawing, vk::Extent2D size, std::size_t faces, std::size_t views);

/// Records the drawing of the views into layers, one per face, which then have the layout `after`. The canvas must not
/// be in use. Throws InputError if a face exceeds the device's viewport.
void record(const vk::raii::CommandBuffer& commands, const FaceDrawing& drawing, const Canvas& canvas,
            std::span<const DrawnView> views, vk::ImageLayout after);

/// The number of faces, at least one, of this size at most, that are drawn at once.
std::size_t facesAtOnce(const FaceDrawing& drawing, vk::Extent2D size);
/// The size that holds all of these faces.
vk::Extent2D sizeOf(std::span<const raster::Face> faces);

/// Submits recorded commands, whose results this program then can read; `done` may be null.
void submit(const FaceDrawing& drawing, const vk::raii::CommandBuffer& commands, vk::Fence done = nullptr);

/// The fault of a device that fails.
raster::InputError failureOf(const vk::SystemError& error);

}  // namespace hemitex::reference
