/// The seam where a rasterizer is plugged in: views in, words out. The solver asks this interface and does not know
/// whether a CPU or a GPU answers. SoftwareRenderer (software_renderer.h) is the reference; the author of a GPU
/// backend implements this one class.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/face.h"

namespace hemitex::raster {

class ItemBufferRenderer {
 public:
  virtual ~ItemBufferRenderer() = default;

  /// Draws the faces, one item buffer each, in their order. `skipped` holds the triangles to leave out, numbered as
  /// in the DrawList that the renderer was made for (triangle t has indices 3t to 3t + 2), in ascending order.
  virtual std::vector<ItemBuffer> render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) = 0;
};

}  // namespace hemitex::raster
