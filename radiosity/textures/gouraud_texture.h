/// Draws elements as Gouraud shaded polygons into a radiosity texture (Nielsen and Christensen 2002, section 3.3). For
/// surfaces of many triangles and charts with holes, where the chart cuts texels.
///
/// The intersections of texels and triangles of the chart are convex polygons. At each of their corners the radiosity
/// is the mean over the adjacent elements; inside its texel it is that of one element. Between corners it is
/// interpolated over the triangles of a fan. Where the corner of a polygon lies on the side of another, as between
/// quadtree leaves of different sizes, there may be a small discontinuity.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// See filteredTexels. A texel of the texture shows the radiosity at its centre. If the chart does not cover the
/// centre, it shows the mean of the corners of the last polygon in its grid texel. Without a polygon it shows the
/// element that the grid texel maps to.
std::vector<glm::dvec3> gouraudTexels(const Surface& surface, const Grid& grid,
                                      const std::vector<glm::dvec3>& radiosity, int magnification);

}  // namespace hemitex::radiosity
