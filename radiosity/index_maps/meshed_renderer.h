/// The renderer of a mesh: whoever leaves out a triangle of the scene leaves out all its pieces.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

class MeshedRenderer final : public raster::ItemBufferRenderer {
 public:
  /// `pieces` draws the list of MeshedDraws, and `firstPiece` is theirs.
  MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces, std::vector<std::uint32_t> firstPiece);

  /// `skipped` are triangles of the scene.
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers) override;
  void drawEach(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  std::vector<std::uint32_t> piecesOf(std::span<const std::uint32_t> triangles) const;

  std::unique_ptr<raster::ItemBufferRenderer> pieces_;
  std::vector<std::uint32_t> firstPiece_;
};

}  // namespace hemitex::radiosity
