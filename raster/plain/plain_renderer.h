/// The rules of docs/item-buffers.md as a program to read: a renderer without tiles, clusters, vectors or threads. It
/// draws each triangle of a face in turn, pixel by pixel, in the order of that page: view, clip, snap, cover, facing,
/// depth, texel, blend. SoftwareRenderer (software_renderer.h) gives the same item IDs many times faster.
#pragma once

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::raster {

class PlainRenderer final : public ItemBufferRenderer {
 public:
  /// Throws InputError if the list breaks the rules (see validate).
  explicit PlainRenderer(DrawList list);

  /// Throws InputError if a face breaks the rules. May be called from several threads at a time.
  void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped, std::vector<ItemBuffer>& buffers,
            const std::function<void(std::size_t)>& drawn) override;

 private:
  DrawList list_;
};

}  // namespace hemitex::raster
