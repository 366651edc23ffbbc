/// The reference renderer: the raster rules on the CPU, bit for bit, for any number of threads.
///
/// Each face is drawn in two passes. The first finds for every pixel the triangle with the largest 1/w; the second
/// resolves the texel and blends the word, once a visible pixel. Both decide in binary64 where its error bound
/// allows, and in exact arithmetic (exact_plane.h) where it does not.
#pragma once

#include "raster/cluster.h"
#include "raster/draw_list.h"
#include "raster/item_buffer_renderer.h"

namespace hemitex::raster {

class SoftwareRenderer final : public ItemBufferRenderer {
 public:
  /// Throws InputError where the list breaks the rules (see validate).
  explicit SoftwareRenderer(DrawList list);

  std::vector<ItemBuffer> render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) override;

  /// Triangles dropped so far because the vertex stage gave a value that is not finite, summed over all faces drawn.
  std::uint64_t droppedTriangles() const { return dropped_; }

  const DrawList& drawList() const { return list_; }

 private:
  DrawList list_;
  std::vector<std::vector<Cluster>> chunks_;  ///< of all draws in order: what one task turns into screen triangles
  std::uint64_t dropped_ = 0;
};

}  // namespace hemitex::raster
