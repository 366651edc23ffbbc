#include "raster/software/software_renderer.h"

#include <utility>

#include "raster/base/parallel.h"
#include "raster/base/pool.h"
#include "raster/kernels/kernels.h"
#include "raster/software/tile.h"

namespace hemitex::raster {

struct SoftwareRenderer::Scene {
  PreparedDrawList draws;
  const Kernels& kernels;
  Pool<TileMemory> memory = {};

  void drawFace(const Face& face, std::span<const std::uint32_t> skipped, ItemBuffer& buffer) {
    buffer.resize(face.scissor);
    const std::vector<Scissor> tiles = tilesOf(face);
    parallelFor(tiles.size(), [&](std::size_t i) {
      Face part = face;
      part.scissor = tiles[i];
      const auto pitch = static_cast<std::size_t>(face.scissor.width);
      const auto pixel = static_cast<std::size_t>(part.scissor.row - face.scissor.row) * pitch +
                         static_cast<std::size_t>(part.scissor.column - face.scissor.column);
      memory.with([&](TileMemory& scratch) {
        drawTile(draws, kernels, part, skipped, scratch, buffer.ids.data() + pixel, pitch);
      });
    });
  }
};

SoftwareRenderer::SoftwareRenderer(DrawList list) : SoftwareRenderer(std::move(list), bestKernels()) {}
SoftwareRenderer::SoftwareRenderer(DrawList list, const Kernels& kernels)
    : scene_(new Scene{prepare(std::move(list)), kernels}) {}
SoftwareRenderer::~SoftwareRenderer() = default;

const DrawList& SoftwareRenderer::drawList() const { return scene_->draws.list; }

void SoftwareRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                            std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  for (const Face& face : faces) {
    validate(face);
    requireUsual(face);
  }
  buffers.resize(faces.size());
  parallelFor(faces.size(), [&](std::size_t f) {
    scene_->drawFace(faces[f], skipped, buffers[f]);
    drawn(f);
  });
}

}  // namespace hemitex::raster
