/// A renderer without tiles, clusters, vectors or threads. It draws each triangle of a face in turn, pixel by pixel, by
/// the functions of rules.h. SoftwareRenderer (software_renderer.h) gives the same item IDs many times faster.
#pragma once

#include <span>
#include <vector>

#include "raster/interface/item_buffer_renderer.h"
#include "raster/plain/rules.h"

namespace hemitex::raster {

/// View, clip, snap and cull: the triangles on the picture of a face, in draw order, without the `skipped` (ascending).
std::vector<SnappedTriangle> snappedTriangles(const DrawList& list, const Face& face,
                                              std::span<const std::uint32_t> skipped = {});

/// Cover and depth: what each pixel of a scissor rectangle shows, row by row. It refers to the triangles.
std::vector<CoveredSample> visibleSamples(const DrawList& list, std::span<const SnappedTriangle> triangles,
                                          const Scissor& scissor);

class PlainRenderer final : public ItemBufferRenderer {
 public:
  /// Throws InputError if the list breaks the rules (see validate).
  explicit PlainRenderer(const DrawList& list);

  /// Throws InputError if a face breaks the rules. May be called from several threads at a time.
  void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped, std::vector<ItemBuffer>& buffers,
            const std::function<void(std::size_t)>& drawn) override;

 private:
  DrawList list_;
};

}  // namespace hemitex::raster
