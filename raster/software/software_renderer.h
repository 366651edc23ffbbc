/// The reference renderer: implements docs/item-buffers.md on the CPU, bit for bit, for any number of threads.
///
/// Each face is divided into tiles (tile.h), which are drawn independently: first depth, then one item ID per visible
/// pixel. Both are computed in floating point where its error bound allows (kernels.h), else in exact arithmetic
/// (exact_interpolation.h). rules.h has the same rules, for readers.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::raster {

struct Kernels;

class SoftwareRenderer final : public ItemBufferRenderer {
 public:
  /// Throws InputError if the list breaks the rules (see validate).
  explicit SoftwareRenderer(DrawList list);
  /// As above, with the kernels of a certain instruction set (kernels.h), which must outlive the renderer.
  SoftwareRenderer(DrawList list, const Kernels& kernels);
  ~SoftwareRenderer() override;

  /// Throws InputError if a face breaks the rules. May be called from several threads at a time.
  void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped, std::vector<ItemBuffer>& buffers,
            const std::function<void(std::size_t)>& drawn) override;

  const DrawList& drawList() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace hemitex::raster
