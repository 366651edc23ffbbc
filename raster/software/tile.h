/// Tiles: a face is drawn in parts, each on its own and small enough to stay in a processor's second-level cache. In a
/// tile, triangles are set up and offered to the depth buffer, the nearest clusters first; then the item IDs of the
/// pixels are resolved, once a visible pixel. Small triangles have as few pixels as there are of them: theirs are
/// resolved while all that they need is at hand, when a pixel takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/interface/face.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/depth_kernels.h"
#include "raster/kernels/small_triangle_kernels.h"
#include "raster/kernels/texel_kernels.h"
#include "raster/kernels/vertex_kernels.h"
#include "raster/setup/triangle_setup.h"
#include "raster/software/prepared_draw_list.h"
#include "raster/software/shading.h"

namespace hemitex::raster {

/// Scissor rectangles that together are the face's own.
std::vector<Scissor> tilesOf(const Face& face);

/// What a tile takes while it is drawn, kept for the next one: memory that is given back and asked for again with every
/// tile may cost as much time as drawing it.
struct TileMemory {
  DepthBuffer buffer;
  std::vector<ScreenTriangle> taken;     ///< by some pixel
  std::vector<Shading> shadings;         ///< of those that a pixel shows in the end
  std::vector<std::uint32_t> shadingOf;  ///< of a taken triangle: its place in `shadings`, or noTriangle
  std::vector<ItemId> row;
  UndecidedPixels undecided;
  PlacedVertices placed;                  ///< of the cluster that is drawn
  std::vector<ScreenTriangle> triangles;  ///< of the cluster
  SmallSamples samples;                   ///< of the cluster
};

/// What a tile is drawn with: the best of each, where nothing else is asked for.
struct TileKernels {
  const VertexKernels& vertices = bestVertexKernels();
  const SmallTriangleKernels& smallTriangles = bestSmallTriangleKernels();
  const DepthKernels& depth = bestDepthKernels();
  const TexelKernels& texels = bestTexelKernels();
};

/// Draws the part of a face that lies in its scissor rectangle: an item ID a pixel, row by row from `ids` on, `pitch`
/// item IDs from row to row. What the memory holds before does not matter.
void drawTile(const PreparedDrawList& draws, const TileKernels& kernels, const Face& face,
              std::span<const std::uint32_t> skipped, TileMemory& memory, ItemId* ids, std::size_t pitch);

}  // namespace hemitex::raster
