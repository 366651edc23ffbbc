/// From a point of the chart to the point of the surface: the centres of patches and elements.
#include <cassert>

#include "radiosity/cell_clipping.h"
#include "radiosity/discretization.h"
#include "radiosity/texel_areas.h"

namespace hemitex::radiosity {
namespace {

/// The element of a patch whose own texel or leaf is nearest to a point in texels; the first of equals.
std::uint32_t nearestElement(const Discretization& discretization, const Patch& patch, const glm::dvec2& point) {
  assert(patch.elementCount > 0);
  const Grid& grid = discretization.grids[patch.surface];
  const auto squaredDistance = [&](std::uint32_t element) {
    const Leaf leaf = leafOf(grid, discretization.elements[element].texel);
    const glm::dvec2 offset = glm::dvec2(leaf.column, leaf.row) + leaf.side / 2.0 - point;
    return glm::dot(offset, offset);
  };
  std::uint32_t nearest = discretization.patchElements[patch.firstElement];
  for (std::uint32_t i = 1; i < patch.elementCount; ++i) {
    const std::uint32_t element = discretization.patchElements[patch.firstElement + i];
    if (squaredDistance(element) < squaredDistance(nearest)) nearest = element;
  }
  return nearest;
}

}  // namespace

SurfacePoint pointOn(const Surface& surface, std::uint32_t number, const glm::dvec2& weights) {
  const Triangle& triangle = surface.triangles[number];
  const glm::dvec3 position = triangle.position[0] + weights.x * (triangle.position[1] - triangle.position[0]) +
                              weights.y * (triangle.position[2] - triangle.position[0]);
  return {position, normal(triangle), number};
}

/// Looks at every triangle of the surface, as the hemicube that is drawn from there does as well.
SurfacePoint patchCentre(const Scene& scene, const Discretization& discretization, const Patch& patch) {
  const Surface& surface = scene.surfaces[patch.surface];
  const Grid& grid = discretization.grids[patch.surface];
  const glm::dvec2 middle = glm::dvec2(patch.column, patch.row) + glm::dvec2(patch.width, patch.height) / 2.0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    if (const auto weights = weightsAt(inTexels(surface.triangles[t], grid.columns, grid.rows), middle))
      return pointOn(surface, t, *weights);
  return elementCentre(scene, discretization, nearestElement(discretization, patch, middle));
}

/// A leaf of a quadtree is a texel of a grid that is so much coarser.
SurfacePoint elementCentre(const Scene& scene, const Discretization& discretization, std::uint32_t number) {
  const Element& element = discretization.elements[number];
  const std::uint32_t triangle = discretization.triangleOf[number];
  const Surface& surface = scene.surfaces[element.surface];
  const Grid& grid = discretization.grids[element.surface];
  const Leaf leaf = leafOf(grid, element.texel);
  const int column = leaf.column / leaf.side, row = leaf.row / leaf.side;
  const std::array<glm::dvec2, 3> corners =
      inTexels(surface.triangles[triangle], grid.columns / leaf.side, grid.rows / leaf.side);
  if (const auto weights = weightsAt(corners, glm::dvec2(column, row) + 0.5))
    return pointOn(surface, triangle, *weights);
  const Piece piece = clippedToCell(corners, column, row);
  return pointOn(surface, triangle, centroid(piece.size > 0 ? piece : wholeTriangle(corners)));
}

}  // namespace hemitex::radiosity
