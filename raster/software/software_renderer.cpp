#include "raster/software/software_renderer.h"

#include <utility>

#include "raster/base/parallel.h"

namespace hemitex::raster {

SoftwareRenderer::SoftwareRenderer(DrawList list, const TileKernels& kernels)
    : draws_(prepare(std::move(list))), kernels_(kernels) {}

void SoftwareRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                            std::vector<ItemBuffer>& buffers) {
  drawEach(faces, skipped, buffers, [](std::size_t) {});
}

void SoftwareRenderer::drawEach(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                                std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  for (const Face& face : faces) validate(face);
  buffers.resize(faces.size());
  parallelFor(faces.size(), [&](std::size_t f) {
    drawFace(faces[f], skipped, buffers[f]);
    drawn(f);
  });
}

void SoftwareRenderer::drawFace(const Face& face, std::span<const std::uint32_t> skipped, ItemBuffer& buffer) {
  buffer.resize(face.scissor);
  const std::vector<Scissor> tiles = tilesOf(face);
  std::vector<std::uint64_t> dropped(tiles.size());
  parallelFor(tiles.size(), [&](std::size_t i) {
    Face part = face;
    part.scissor = tiles[i];
    const auto pitch = static_cast<std::size_t>(face.scissor.width);
    const auto pixel = static_cast<std::size_t>(part.scissor.row - face.scissor.row) * pitch +
                       static_cast<std::size_t>(part.scissor.column - face.scissor.column);
    dropped[i] = drawTile(draws_, kernels_, part, skipped, memory_.mine(), buffer.ids.data() + pixel, pitch);
  });
  // All tiles count the same triangles that are not finite; only the first tile of a face is added.
  if (!dropped.empty()) dropped_ += dropped.front();
}

}  // namespace hemitex::raster
