/// Elements drawn as Gouraud shaded polygons into a radiosity texture (Nielsen and Christensen 2002, section 3.3): for
/// surfaces of many triangles and charts with holes, where texels are cut.
///
/// What texels cut out of the chart's triangles are convex polygons. At each of their corners the radiosity is the mean
/// over the elements that meet there, one element's own inside its texel; between them it is interpolated over the
/// triangles of a fan. Where corners of one
/// polygon lie within a side of another, as where leaves of a quadtree differ in size, both sides may jump a little.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// See filteredTexels. A texel of the texture shows what is at its centre or, where the chart leaves that out, the mean
/// of the corners of the last polygon of its texel of the grid, or the element that this spills to.
std::vector<glm::dvec3> gouraudTexels(const Surface& surface, const Grid& grid,
                                      const std::vector<glm::dvec3>& radiosity, int magnification);

}  // namespace hemitex::radiosity
