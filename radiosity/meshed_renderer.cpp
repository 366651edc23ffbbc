#include "radiosity/meshed_renderer.h"

#include <utility>

namespace hemitex::radiosity {

MeshedRenderer::MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces,
                               std::vector<std::uint32_t> firstPiece)
    : pieces_(std::move(pieces)), firstPiece_(std::move(firstPiece)) {}

void MeshedRenderer::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers) {
  std::vector<std::uint32_t> skippedPieces;
  for (const std::uint32_t triangle : skipped)
    for (std::uint32_t piece = firstPiece_[triangle]; piece < firstPiece_[triangle + 1]; ++piece)
      skippedPieces.push_back(piece);
  pieces_->draw(faces, skippedPieces, buffers);
}

}  // namespace hemitex::radiosity
