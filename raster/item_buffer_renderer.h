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
  /// in the DrawList that the renderer was made for (triangle t has indices 3t to 3t + 2), in ascending order. What
  /// `buffers` holds before is of no account but for its memory, which need not be asked for and cleared again.
  virtual void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                    std::vector<ItemBuffer>& buffers) = 0;

  /// The same into buffers of their own.
  std::vector<ItemBuffer> render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) {
    std::vector<ItemBuffer> buffers;
    draw(faces, skipped, buffers);
    return buffers;
  }
};

}  // namespace hemitex::raster
