/// The points that a patch shoots from where its centre alone will not do: the middles of blocks that it is cut into.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/scene.h"

namespace hemitex::radiosity {

/// A point of a surface that a part of its area shoots from.
struct ShootingBlock {
  SurfacePoint centre;  ///< the surface's point at the middle of the block or, where the chart does not cover that, the
                        ///< centroid of the largest piece of the surface inside
  double area = 0;      ///< of the surface inside the block, above 0
};

/// A rectangle of a surface's chart, in the texels of its grid; nothing where the surface has no area there. Looks at
/// every triangle of the surface.
std::optional<ShootingBlock> shootingBlock(const Surface& surface, const Grid& grid, const glm::dvec2& corner,
                                           const glm::dvec2& size);

/// The blocks of a patch, points x points of them, row by row, those without area left out.
std::vector<ShootingBlock> shootingBlocks(const Scene& scene, const Discretization& discretization, const Patch& patch);

}  // namespace hemitex::radiosity
