/// The points that a patch shoots from where its centre alone will not do: the middles of blocks that it is cut into.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A point on a surface with the normal there, and the triangle of the surface that it lies on.
struct SurfacePoint {
  glm::dvec3 position;         ///< in the file's units
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< in Surface::triangles
};

/// The point of a triangle of a surface with these barycentric weights, of its corners 1 and 2.
SurfacePoint pointOn(const Surface& surface, std::uint32_t triangle, const glm::dvec2& weights);

/// The centre of a patch: the centroid in the chart of what is exposed in its block or, where that is not exposed
/// itself, a point of the exposed piece nearest to it. Always on the surface.
SurfacePoint patchCentre(const Scene& scene, const Discretization& discretization, const Patch& patch);

/// The centre of an element: the surface's point at the middle of its own texel or leaf or, where the chart does not
/// cover that, at the centroid of the largest piece of the surface inside. Where the texel or leaf is buried in part it
/// is the centroid of what is exposed or, where that is not exposed itself, a point of the exposed piece nearest to it.
/// Always on the surface.
SurfacePoint elementCentre(const Scene& scene, const Discretization& discretization, std::uint32_t element);

/// A point of a surface that a part of its area shoots from.
struct ShootingBlock {
  SurfacePoint centre;  ///< the centroid, in the chart, of what is exposed in the block or, where that is not exposed
                        ///< itself, the centroid of the exposed piece nearest to it
  double area = 0;      ///< of the exposed surface inside the block, above 0
};

/// A rectangle of a surface's chart, in the texels of its grid; nothing where the surface has no exposed area there.
/// Looks at every triangle of the surface.
std::optional<ShootingBlock> shootingBlock(const Surface& surface, const Grid& grid, const glm::dvec2& corner,
                                           const glm::dvec2& size);

/// The blocks of a patch, points x points of them, row by row, those without area left out.
std::vector<ShootingBlock> shootingBlocks(const Scene& scene, const Discretization& discretization, const Patch& patch);

}  // namespace hemitex::radiosity
