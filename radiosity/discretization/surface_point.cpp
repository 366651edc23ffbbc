/// From a point of the chart to the point of the surface: the centres of patches and elements.
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::radiosity {
SurfacePoint pointOn(const Surface& surface, std::uint32_t number, const glm::dvec2& weights) {
  const Triangle& triangle = surface.triangles[number];
  const glm::dvec3 position = triangle.position[0] + weights.x * (triangle.position[1] - triangle.position[0]) +
                              weights.y * (triangle.position[2] - triangle.position[0]);
  return {position, normal(triangle), number};
}

SurfacePoint patchCentre(const Scene& scene, const Discretization& discretization, const Patch& patch) {
  const auto block = shootingBlock(scene.surfaces[patch.surface], discretization.grids[patch.surface],
                                   glm::dvec2(patch.column, patch.row), glm::dvec2(patch.width, patch.height));
  // Where a chart has next to no area in the block it may have none left, to within rounding.
  return block ? block->centre : elementCentre(scene, discretization, discretization.patchElements[patch.firstElement]);
}

/// A leaf of a quadtree is a texel of a grid that is so much coarser.
SurfacePoint elementCentre(const Scene& scene, const Discretization& discretization, std::uint32_t number) {
  const Element& element = discretization.elements[number];
  const std::uint32_t triangle = discretization.triangleOf[number];
  const Surface& surface = scene.surfaces[element.surface];
  const Grid& grid = discretization.grids[element.surface];
  const Leaf leaf = leafOf(grid, element.texel);
  const glm::dvec2 corner(leaf.column, leaf.row);
  if (hasCutTexel(texelGrid(grid), corner, corner + static_cast<double>(leaf.side)))
    if (const auto block = shootingBlock(surface, grid, corner, glm::dvec2(leaf.side))) return block->centre;
  const int column = leaf.column / leaf.side, row = leaf.row / leaf.side;
  const std::array<glm::dvec2, 3> corners =
      inTexels(surface.triangles[triangle], grid.columns / leaf.side, grid.rows / leaf.side);
  if (const auto weights = weightsAt(corners, glm::dvec2(column, row) + 0.5))
    return pointOn(surface, triangle, *weights);
  const Piece piece = clippedToCell(corners, column, row);
  return pointOn(surface, triangle, centroid(piece.size > 0 ? piece : wholeTriangle(corners)));
}

}  // namespace hemitex::radiosity
