/// Interface that a rasterizer backend implements: faces in, item buffers out. SoftwareRenderer (software_renderer.h)
/// is the reference implementation on the CPU. A GPU backend derives from this class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "raster/interface/face.h"
#include "raster/interface/pixel_sums.h"

namespace hemitex::raster {

class ItemBufferRenderer {
 public:
  virtual ~ItemBufferRenderer() = default;

  /// Draws the faces, one item buffer per face, in their order. `skipped` holds the triangles to leave out, numbered as
  /// in the DrawList that the renderer was made for (triangle t has indices 3t to 3t + 2), in ascending order. Old
  /// contents of `buffers` are ignored; their memory is reused.
  ///
  /// Calls drawn(f) once the buffer of face f is complete. A renderer that draws faces one by one or on several threads
  /// calls it at once, so that the caller finds the buffer in the cache; calls may come from several threads at a time.
  virtual void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                    std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) = 0;

  /// Sums pixels to the slots of a table where they are drawn; null if this renderer cannot. Must not outlive it.
  virtual std::unique_ptr<PixelSums> makeSums(const std::function<SlotTable()>& /*table*/) { return nullptr; }
};

/// Draws the faces and returns when all buffers are complete.
void draw(ItemBufferRenderer& renderer, std::span<const Face> faces, std::span<const std::uint32_t> skipped,
          std::vector<ItemBuffer>& buffers);
/// The same into new buffers.
std::vector<ItemBuffer> render(ItemBufferRenderer& renderer, std::span<const Face> faces,
                               std::span<const std::uint32_t> skipped = {});

inline std::vector<ItemBuffer> render(ItemBufferRenderer&& renderer, std::span<const Face> faces,
                                      std::span<const std::uint32_t> skipped = {}) {
  return render(renderer, faces, skipped);
}

}  // namespace hemitex::raster
