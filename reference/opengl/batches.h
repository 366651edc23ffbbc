/// What a device draws with one call. A scene may have thousands of draws, and a call costs more than a triangle: draws
/// that can be drawn together make one batch. Triangles that are left out are holes between the runs of its vertices,
/// so that the buffers stay as they are.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"

namespace hemitex::reference {

/// Runs of vertices that are drawn together.
struct VertexRuns {
  std::vector<GLint> first;
  std::vector<GLsizei> count;

  /// The vertices in [from, end), which begin where the last run ends or behind it.
  void add(GLint from, GLint end);
  /// In their order, out of the buffers that are bound.
  void draw() const;
};

/// Whether the device may draw `next` together with `draw` before it.
using DrawsJoin = std::function<bool(const raster::Draw& draw, const raster::Draw& next)>;

/// Draws that are drawn together, by the first of them.
struct DrawBatch {
  const raster::Draw* draw;  ///< in the list
  VertexRuns runs;
};

/// What is left of the draws without the `skipped` triangles (see ItemBufferRenderer::draw). Vertices are counted as
/// they lie in the buffers: draw after draw, as in texelTriangles. The batches point into the list.
std::vector<DrawBatch> batchesOf(const raster::DrawList& list, std::span<const std::uint32_t> skipped,
                                 const DrawsJoin& join);

}  // namespace hemitex::reference
