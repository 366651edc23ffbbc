/// Converts a quadtree to a radiosity texture without discontinuities (Bastos, Goslin and Zhang 1997).
///
/// Values at the corners of leaves are interpolated bilinearly over each leaf. A vertex has one leaf in each quadrant.
/// With weights of 1 / side, the mean of the leaf centres is the vertex, so that linear fields are reproduced. At the
/// chart's edge, with two leaves or one, the mean lies inside the chart. It is extrapolated to the edge, but not below
/// 0 (Cohen and Greenberg 1985). The line starts at the vertex on the other side of the larger leaf. A vertex in the
/// middle of a larger leaf's edge gets the mean of the ends of this edge. So leaves of different sizes agree. So the
/// texture is continuous.
///
/// Leaves without area are ignored. For a grid of single texels this is the 3 x 3 triangle filter, except at edges.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// See filteredTexels. The quadtree must be balanced.
std::vector<glm::dvec3> quadtreeTexels(const Discretization& discretization, const Grid& grid,
                                       const std::vector<glm::dvec3>& radiosity, int magnification);

}  // namespace hemitex::radiosity
