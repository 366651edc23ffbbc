/// Batches: draws that the device draws with one call. A scene may have thousands of draws, and a call takes longer
/// than a triangle, so compatible draws are joined. Skipped triangles are gaps between the runs of vertices, so that
/// the buffers stay the same.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"

namespace hemitex::reference {

/// Runs of vertices that are drawn together.
struct VertexRuns {
  std::vector<int> first;
  std::vector<int> count;
};

/// Draws that are drawn together, represented by the first of them.
struct DrawBatch {
  const raster::Draw* draw;  ///< in the list
  VertexRuns runs;
};

/// The batches of all draws without the `skipped` triangles (see ItemBufferRenderer::draw). Vertices are numbered as
/// the corners of triangles: draw after draw. The batches point into the list. `joins` tells whether the device may
/// draw `next` together with `draw` before it.
std::vector<DrawBatch> batchesOf(const raster::DrawList& list, std::span<const std::uint32_t> skipped,
                                 const std::function<bool(const raster::Draw& draw, const raster::Draw& next)>& joins);

}  // namespace hemitex::reference
