/// The reference renderer: the raster rules on the CPU, bit for bit, for any number of threads.
///
/// Each face is cut into tiles (tile.h), which are drawn independently of each other: depth first, then one item ID a
/// visible pixel. Both decide in floating point where its error bound allows (depth_kernels.h, texel_kernels.h), and in
/// exact arithmetic (exact_interpolation.h) where it does not.
#pragma once

#include "raster/base/per_thread.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"
#include "raster/software/tile.h"

namespace hemitex::raster {

class SoftwareRenderer final : public ItemBufferRenderer {
 public:
  /// Throws InputError where the list breaks the rules (see validate).
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
