#include "radiosity/discretization/patch_points.h"

#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::radiosity {
namespace {

/// An exposed piece in a block.
struct BlockPiece {
  std::uint32_t triangle = 0;
  Piece piece;
  double area = 0;         ///< on the surface
  glm::dvec2 centre{0.0};  ///< in texels
};

/// The polygon has the point inside or on its border; polygons of a chart may wind either way.
bool contains(const Piece& piece, const glm::dvec2& point) {
  bool isLeft = true, isRight = true;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const glm::dvec2 a = piece.corners[i].grid - point, b = piece.corners[(i + 1) % piece.size].grid - point;
    const double side = a.x * b.y - a.y * b.x;
    isLeft = isLeft && side >= 0;
    isRight = isRight && side <= 0;
  }
  return isLeft || isRight;
}

std::vector<BlockPiece> piecesIn(const Surface& surface, const Grid& grid, const glm::dvec2& corner,
                                 const glm::dvec2& size) {
  std::vector<BlockPiece> pieces;
  forEachExposedPiece(
      surface, texelGrid(grid), corner, corner + size, [&](std::size_t, std::uint32_t t, const Piece& piece) {
        const double inside = share(piece) * area(surface.triangles[t]);
        if (!(inside > 0)) return;
        const std::array<glm::dvec2, 3> corners = inTexels(surface.triangles[t], grid.columns, grid.rows);
        const glm::dvec2 weights = centroid(piece);
        pieces.push_back({t, piece, inside,
                          corners[0] + weights.x * (corners[1] - corners[0]) + weights.y * (corners[2] - corners[0])});
      });
  return pieces;
}

}  // namespace

std::optional<ShootingBlock> shootingBlock(const Surface& surface, const Grid& grid, const glm::dvec2& corner,
                                           const glm::dvec2& size) {
  const std::vector<BlockPiece> pieces = piecesIn(surface, grid, corner, size);
  if (pieces.empty()) return std::nullopt;
  ShootingBlock block;
  glm::dvec2 moment(0);
  for (const BlockPiece& piece : pieces) {
    block.area += piece.area;
    moment += piece.area * (piece.centre - corner);
  }
  const glm::dvec2 middle = corner + moment / block.area;
  const BlockPiece* nearest = &pieces.front();
  for (const BlockPiece& piece : pieces) {
    if (contains(piece.piece, middle))
      if (const auto weights =
              weightsAt(inTexels(surface.triangles[piece.triangle], grid.columns, grid.rows), middle)) {
        block.centre = pointOn(surface, piece.triangle, *weights);
        return block;
      }
    if (glm::distance(piece.centre, middle) < glm::distance(nearest->centre, middle)) nearest = &piece;
  }
  block.centre = pointOn(surface, nearest->triangle, centroid(nearest->piece));
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
