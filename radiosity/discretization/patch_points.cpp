#include "radiosity/discretization/patch_points.h"

#include <algorithm>
#include <limits>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::radiosity {

glm::dvec3 eyeOver(const Scene& scene, std::uint32_t surface, const SurfacePoint& point) {
  if (surface == noSurface) return point.position + contactTolerance(scene) * point.normal;
  const std::array<glm::dvec3, 3>& corner = scene.surfaces[surface].triangles[point.triangle].position;
  const glm::dvec3 inward = (corner[0] + corner[1] + corner[2]) / 3.0 - point.position;
  const double distance = glm::length(inward);
  const double share = distance > 0 ? std::min(0.5, outlineTolerance(scene) / distance) : 0;
  return point.position + share * inward + contactTolerance(scene) * point.normal;
}

SurfacePoint pointOn(const Surface& surface, std::uint32_t number, const glm::dvec2& weights) {
  const Triangle& triangle = surface.triangles[number];
  const glm::dvec3 position = triangle.position[0] + weights.x * (triangle.position[1] - triangle.position[0]) +
                              weights.y * (triangle.position[2] - triangle.position[0]);
  return {position, normal(triangle), number};
}

SurfacePoint patchCentre(const Scene& scene, const Discretization& discretization, const Patch& patch) {
  const auto block = shootingBlock(scene.surfaces[patch.surface], discretization.grids[patch.surface],
                                   glm::dvec2(patch.column, patch.row), glm::dvec2(patch.width, patch.height));
  // If the chart has almost no area in the block, rounding may leave none.
  return block ? block->centre : elementCentre(scene, discretization, patch.elements.front());
}

/// A leaf of a quadtree is a texel of a coarser grid.
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

namespace {

/// Normals whose cosines to a direction differ by less are equal, up to the tolerance of planar parts.
constexpr double equalCosines = 1e-4;

/// An exposed piece in a block.
struct BlockPiece {
  std::uint32_t triangle = 0;
  Piece piece;
  double area = 0;         ///< on the surface
  glm::dvec2 centre{0.0};  ///< in texels
};

/// Whether the point lies inside the polygon or on its border; polygons of a chart may have either winding.
bool containsPoint(const Piece& piece, const glm::dvec2& point) {
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

/// The pieces whose normal is nearest to the mean normal, or all where a block is flat.
std::vector<BlockPiece> facingPieces(const Surface& surface, const std::vector<BlockPiece>& pieces) {
  if (pieces.size() == 1) return pieces;
  std::vector<glm::dvec3> normals;
  glm::dvec3 sum(0);
  for (const BlockPiece& piece : pieces) {
    normals.push_back(normal(surface.triangles[piece.triangle]));
    sum += piece.area * normals.back();
  }
  double largest = std::numeric_limits<double>::lowest();
  for (const glm::dvec3& n : normals) largest = std::max(largest, glm::dot(n, sum));
  std::vector<BlockPiece> facing;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (largest - glm::dot(normals[i], sum) <= equalCosines * glm::length(sum)) facing.push_back(pieces[i]);
  return facing;
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
  const std::vector<BlockPiece> facing = facingPieces(surface, pieces);
  const BlockPiece* nearest = &facing.front();
  for (const BlockPiece& piece : facing) {
    if (containsPoint(piece.piece, middle))
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

std::vector<glm::dvec3> meanNormals(const Surface& surface, const Grid& grid) {
  std::vector<glm::dvec3> sums(grid.elementCount, glm::dvec3(0));
  forEachExposedPiece(surface, texelGrid(grid), [&](std::size_t texel, std::uint32_t t, const Piece& piece) {
    const Triangle& triangle = surface.triangles[t];
    sums[grid.elementOfTexel[texel] - grid.firstElement] += share(piece) * area(triangle) * normal(triangle);
  });
  for (glm::dvec3& sum : sums)
    if (const double length = glm::length(sum); length > 0) sum /= length;
  return sums;
}

std::function<SurfacePoint(std::uint32_t)> elementPlaces(const Scene& scene, const Discretization& discretization) {
  std::vector<std::vector<glm::dvec3>> means(scene.surfaces.size());  // of curved surfaces
  for (std::size_t s = 0; s < means.size(); ++s)
    if (scene.surfaces[s].curvedPart) means[s] = meanNormals(scene.surfaces[s], discretization.grids[s]);
  return [&scene, &discretization, means](std::uint32_t element) {
    const std::uint32_t surface = discretization.elements[element].surface;
    SurfacePoint place = elementCentre(scene, discretization, element);
    if (!means[surface].empty()) place.normal = means[surface][element - discretization.grids[surface].firstElement];
    return place;
  };
}

}  // namespace hemitex::radiosity
