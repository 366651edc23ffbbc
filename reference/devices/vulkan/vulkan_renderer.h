/// A renderer on a real device: Vulkan, without a window. docs/backend.md walks through it as the example of a backend.
///
/// This file and its source record the commands of a view. The device is chosen in context.h, memory is allocated in
/// memory.h, and states and shaders are in pipeline.h. Drawing reads draw_list_buffers.h and writes render_targets.h.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::reference {

class VulkanRenderer final : public raster::ItemBufferRenderer {
 public:
  /// Throws InputError if the list breaks the rules or exceeds the buffers of the device, or if there is no device (see
  /// context.h).
  explicit VulkanRenderer(const raster::DrawList& list);
  ~VulkanRenderer() override;

  /// Throws InputError if a face breaks the rules, or if the device fails.
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::reference
