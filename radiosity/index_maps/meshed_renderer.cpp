#include "radiosity/index_maps/meshed_renderer.h"

#include <utility>

namespace hemitex::radiosity {

MeshedRenderer::MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces,
                               std::vector<std::uint32_t> firstPiece)
    : pieces_(std::move(pieces)), firstPiece_(std::move(firstPiece)) {}

void MeshedRenderer::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers) {
  pieces_->draw(faces, piecesOf(skipped), buffers);
}

void MeshedRenderer::drawEach(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                              std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  pieces_->drawEach(faces, piecesOf(skipped), buffers, drawn);
}

std::vector<std::uint32_t> MeshedRenderer::piecesOf(std::span<const std::uint32_t> triangles) const {
  std::vector<std::uint32_t> pieces;
  for (const std::uint32_t triangle : triangles)
    for (std::uint32_t piece = firstPiece_[triangle]; piece < firstPiece_[triangle + 1]; ++piece)
      pieces.push_back(piece);
  return pieces;
}

}  // namespace hemitex::radiosity
