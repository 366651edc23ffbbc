#include "radiosity/patch_points.h"

#include "radiosity/cell_clipping.h"
#include "radiosity/texel_areas.h"

namespace hemitex::radiosity {
namespace {

bool mayMeetUnitCell(const std::array<glm::dvec2, 3>& corners) {
  const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
  const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
  return low.x < 1 && low.y < 1 && high.x > 0 && high.y > 0;
}

}  // namespace

std::optional<ShootingBlock> shootingBlock(const Surface& surface, const Grid& grid, const glm::dvec2& corner,
                                           const glm::dvec2& size) {
  ShootingBlock block;
  double largest = 0;
  bool coversMiddle = false;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<glm::dvec2, 3> corners = inTexels(surface.triangles[t], grid.columns, grid.rows);
    for (glm::dvec2& texels : corners) texels = (texels - corner) / size;  // the block becomes the unit cell
    if (!mayMeetUnitCell(corners)) continue;
    const Piece piece = clippedToCell(corners, 0, 0);
    if (piece.size == 0) continue;
    const double inside = share(piece) * area(surface.triangles[t]);
    block.area += inside;
    const auto middle = weightsAt(corners, {0.5, 0.5});
    if (coversMiddle || (!middle && inside <= largest)) continue;
    block.centre = pointOn(surface, t, middle ? *middle : centroid(piece));
    largest = inside;
    coversMiddle = middle.has_value();
  }
  if (!(block.area > 0)) return std::nullopt;
  return block;
}

std::vector<ShootingBlock> shootingBlocks(const Scene& scene, const Discretization& discretization,
                                          const Patch& patch) {
  const glm::dvec2 size = glm::dvec2(patch.width, patch.height) / static_cast<double>(patch.points);
  std::vector<ShootingBlock> blocks;
  for (int j = 0; j < patch.points; ++j)
    for (int i = 0; i < patch.points; ++i) {
      const glm::dvec2 corner = glm::dvec2(patch.column, patch.row) + glm::dvec2(i, j) * size;
      if (const auto block =
              shootingBlock(scene.surfaces[patch.surface], discretization.grids[patch.surface], corner, size))
        blocks.push_back(*block);
    }
  return blocks;
}

}  // namespace hemitex::radiosity
