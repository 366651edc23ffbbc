#include "radiosity/meshed_renderer.h"

#include <utility>

namespace hemitex::radiosity {

MeshedRenderer::MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces,
                               std::vector<std::uint32_t> firstPiece)
    : pieces_(std::move(pieces)), firstPiece_(std::move(firstPiece)) {}

std::vector<raster::ItemBuffer> MeshedRenderer::render(std::span<const raster::Face> faces,
                                                       std::span<const std::uint32_t> skipped) {
  std::vector<std::uint32_t> skippedPieces;
  for (const std::uint32_t triangle : skipped)
    for (std::uint32_t piece = firstPiece_[triangle]; piece < firstPiece_[triangle + 1]; ++piece)
      skippedPieces.push_back(piece);
  return pieces_->render(faces, skippedPieces);
}

}  // namespace hemitex::radiosity
