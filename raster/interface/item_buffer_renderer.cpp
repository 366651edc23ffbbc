#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::raster {

void draw(ItemBufferRenderer& renderer, std::span<const Face> faces, std::span<const std::uint32_t> skipped,
          std::vector<ItemBuffer>& buffers) {
  renderer.draw(faces, skipped, buffers, [](std::size_t) {});
}

std::vector<ItemBuffer> render(ItemBufferRenderer& renderer, std::span<const Face> faces,
                               std::span<const std::uint32_t> skipped) {
  std::vector<ItemBuffer> buffers;
  draw(renderer, faces, skipped, buffers);
  return buffers;
}

}  // namespace hemitex::raster
