/// The reference renderer: implements docs/item-buffers.md on the CPU, bit for bit, for any number of threads.
///
/// Each face is divided into tiles (tile.h), which are drawn independently: first depth, then one item ID per visible
/// pixel. Both are computed in floating point where its error bound allows (depth_kernels.h, texel_kernels.h), else in
/// exact arithmetic (exact_interpolation.h).
#pragma once

#include "raster/base/per_thread.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"
#include "raster/software/tile.h"

namespace hemitex::raster {

class SoftwareRenderer final : public ItemBufferRenderer {
 public:
  /// Throws InputError if the list breaks the rules (see validate).
  explicit SoftwareRenderer(DrawList list, const TileKernels& kernels = {});

  /// May be called from several threads at a time.
  void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped, std::vector<ItemBuffer>& buffers,
            const std::function<void(std::size_t)>& drawn) override;

  const DrawList& drawList() const { return draws_.list; }

 private:
  void drawFace(const Face& face, std::span<const std::uint32_t> skipped, ItemBuffer& buffer);

  PreparedDrawList draws_;
  TileKernels kernels_;
  PerThread<TileMemory> memory_;
};

}  // namespace hemitex::raster
