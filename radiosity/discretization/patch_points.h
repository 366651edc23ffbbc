/// The points that a patch shoots from where its centre alone will not do: the middles of blocks that it is cut into.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

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
