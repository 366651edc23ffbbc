/// The seam where a rasterizer is plugged in: views in, item IDs out. The solver asks this interface and does not know
/// whether a CPU or a GPU answers. SoftwareRenderer (software_renderer.h) is the reference; the author of a GPU
/// backend implements this one class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "raster/base/parallel.h"
#include "raster/interface/face.h"

namespace hemitex::raster {

class ItemBufferRenderer {
 public:
  virtual ~ItemBufferRenderer() = default;

  /// Draws the faces, one item buffer each, in their order. `skipped` holds the triangles to leave out, numbered as
  /// in the DrawList that the renderer was made for (triangle t has indices 3t to 3t + 2), in ascending order. What
  /// `buffers` holds before is of no account but for its memory, which need not be asked for and cleared again.
  virtual void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                    std::vector<ItemBuffer>& buffers) = 0;

  /// The same, and calls drawn(f) when the buffer of face f is there: not when all are, where a renderer draws some
  /// before others, and on several threads at a time, where it draws on them. So what reads the buffers finds them in
  /// the cache, and no thread waits for the last face.
  virtual void drawEach(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                        std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
    draw(faces, skipped, buffers);
    parallelFor(faces.size(), drawn);
  }

  /// As `draw`, into buffers of their own.
  std::vector<ItemBuffer> render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) {
    std::vector<ItemBuffer> buffers;
    draw(faces, skipped, buffers);
    return buffers;
  }
};

}  // namespace hemitex::raster
