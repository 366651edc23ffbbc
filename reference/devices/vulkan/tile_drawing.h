/// Draws faces by two compute shaders, which follow the rules alone (docs/item-buffers.md): make_pieces.comp clips and
/// snaps triangles, draw_tiles.comp finds the item ID of each pixel. No fixed function rounds anything. Data-centre
/// cards have few units for graphics, so that this is faster there, too.
#pragma once

#include <span>

#include "reference/devices/vulkan/pipeline.h"

namespace hemitex::reference {

/// Faces that leave out the same triangles.
struct DrawnView {
  std::span<const raster::Face> faces;
  std::span<const std::uint32_t> skipped;  ///< see ItemBufferRenderer::draw
};

/// The buffers of faces that are drawn at once.
struct TileBuffers {
  VulkanBuffer faces, skipped, counts, boxes, pieces;
  VulkanDescriptors descriptors;
};

struct TilePipeline {
  std::uint32_t triangles;
  vk::raii::PipelineLayout layout;
  vk::raii::Pipeline makePieces, drawTiles;
};

/// Throws InputError for lists with holes, culling or values of version 2 of the rules, and for those of too many
/// triangles for the buffers of the device.
TilePipeline makeTilePipeline(const VulkanContext& context, const raster::DrawList& list);

/// Room for `faces` and `views`, which are drawn into the layers of `ids`.
TileBuffers makeTileBuffers(const VulkanContext& context, const TilePipeline& pipeline, const DrawArrays& arrays,
                            const VulkanImage& ids, std::size_t faces, std::size_t views);

/// The number of faces whose clipped triangles fit into so many bytes.
std::size_t facesWithPieces(std::size_t triangles, std::size_t bytes);

/// Records the drawing of views into the layers of an image, in ImageLayout::eGeneral, and fills the input buffers.
void recordTiles(const vk::raii::CommandBuffer& commands, const TilePipeline& pipeline, const TileBuffers& buffers,
                 const raster::DrawList& list, std::span<const DrawnView> views);

}  // namespace hemitex::reference
