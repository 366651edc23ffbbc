/// Interface that a rasterizer backend implements: faces in, item buffers out. SoftwareRenderer (software_renderer.h)
/// is the reference implementation on the CPU. A GPU backend derives from this class.
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

  /// Draws the faces into `buffers`, one item buffer per face, in the order of the faces. `skipped` holds the triangles
  /// to leave out in ascending order; triangle t has the indices 3t to 3t + 2 of the DrawList. Previous contents of
  /// `buffers` are ignored; their allocations are reused.
  virtual void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                    std::vector<ItemBuffer>& buffers) = 0;

  /// As draw, and calls drawn(f) once for each face as soon as its buffer is complete. A renderer may call it on
  /// several threads at a time, and before later faces are drawn. So the caller reads each buffer while it is in the
  /// cache.
  virtual void drawEach(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                        std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
    draw(faces, skipped, buffers);
    parallelFor(faces.size(), drawn);
  }

  /// As draw, into new buffers.
  std::vector<ItemBuffer> render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) {
    std::vector<ItemBuffer> buffers;
    draw(faces, skipped, buffers);
    return buffers;
  }
};

}  // namespace hemitex::raster
