/// A renderer whose pixels are read back and summed here, whether or not it sums pixels itself.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::reference {

class ReadBack final : public raster::ItemBufferRenderer {
 public:
  explicit ReadBack(std::unique_ptr<raster::ItemBufferRenderer> renderer) : renderer_(std::move(renderer)) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    renderer_->draw(faces, skipped, buffers, drawn);
  }

 private:
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
};

}  // namespace hemitex::reference
