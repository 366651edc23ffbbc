/// Tiles: parts of a face that are drawn independently and fit into the second-level cache of a core. In a tile,
/// triangles are set up and tested against the depth buffer, nearest clusters first. Then the item ID is computed once
/// per visible pixel. Small triangles have few pixels each, so that their item IDs are written during the depth test,
/// while their data is in registers. Triangles whose index maps have holes take a slower path: their texels are found
/// before the depth test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/interface/face.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/kernels.h"
#include "raster/setup/triangle_setup.h"
#include "raster/software/prepared_draw_list.h"
#include "raster/software/shading.h"

namespace hemitex::raster {

/// Scissor rectangles that partition that of the face.
std::vector<Scissor> tilesOf(const Face& face);

/// Scratch memory for drawing a tile, reused for the next tile. Allocating it for every tile can take as long as
/// drawing.
struct TileMemory {
  DepthBuffer buffer;
  std::vector<ScreenTriangle> taken;     ///< triangles that some pixel took
  std::vector<Shading> shadings;         ///< of triangles that are visible in the end
  std::vector<std::uint32_t> shadingOf;  ///< per taken triangle: its place in `shadings`, or noTriangle
  std::vector<ItemId> run;               ///< item IDs of a run; kernels write behind its end
  std::vector<double> runDepths;         ///< 1/w of a run; kernels read behind its end
  UnresolvedPixels unresolved;
  PlacedVertices placed;                  ///< of the current cluster
  std::vector<ScreenTriangle> triangles;  ///< of the current cluster
  SmallSetup small;                       ///< of the current cluster
  UnresolvedSamples unresolvedSamples;
};

/// Draws the part of a face in its scissor rectangle: one item ID per pixel, row by row from `ids` on, `pitch` item IDs
/// from row to row. Previous contents of `ids` are ignored.
void drawTile(const PreparedDrawList& draws, const Kernels& kernels, const Face& face,
              std::span<const std::uint32_t> skipped, TileMemory& memory, ItemId* ids, std::size_t pitch);

}  // namespace hemitex::raster
