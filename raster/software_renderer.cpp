#include "raster/software_renderer.h"

#include <utility>

#include "raster/parallel.h"

namespace hemitex::raster {

SoftwareRenderer::SoftwareRenderer(DrawList list, const PixelKernels& kernels)
    : draws_(prepare(std::move(list))), kernels_(kernels) {}

void SoftwareRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                            std::vector<ItemBuffer>& buffers) {
  for (const Face& face : faces) validate(face);

  struct Task {
    std::size_t face;
    Scissor tile;
    std::uint64_t dropped = 0;
  };
  std::vector<Task> tasks;
  buffers.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    buffers[f].resize(faces[f].scissor);
    for (const Scissor& tile : tilesOf(faces[f])) tasks.push_back({f, tile});
  }
  parallelFor(tasks.size(), [&](std::size_t i) {
    Task& task = tasks[i];
    Face part = faces[task.face];
    const auto pitch = static_cast<std::size_t>(part.scissor.width);
    const auto pixel = static_cast<std::size_t>(task.tile.row - part.scissor.row) * pitch +
                       static_cast<std::size_t>(task.tile.column - part.scissor.column);
    part.scissor = task.tile;
    task.dropped = drawTile(draws_, kernels_, part, skipped, buffers[task.face].words.data() + pixel, pitch);
  });
  // Every tile meets what is not finite: the first one of a face speaks for it.
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (i == 0 || tasks[i].face != tasks[i - 1].face) dropped_ += tasks[i].dropped;
}

}  // namespace hemitex::raster
