/// A quadtree flattened into a radiosity texture without discontinuities (Bastos, Goslin and Zhang 1997).
///
/// Values at the corners of leaves are interpolated bilinearly over each leaf. Four leaves meet at a vertex, one in
/// each quadrant; weighted by 1 / side, their centres have the vertex as their mean, so their values have that of a
/// linear field there. On the chart's edge, where two meet or one, that mean lies within the chart; it is carried on to
/// the edge along the line from the vertex on the other side of the larger leaf (Cohen and Greenberg 1985), but not
/// below 0. A vertex in the middle of a larger leaf's edge is constrained to the mean of the edge's ends, so that
/// leaves of different sizes agree along it. So linear fields are reproduced, and the texture is continuous.
///
/// Leaves without area take no part. On a grid of single texels this is the 3 x 3 triangle filter, but for the edges.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// See filteredTexels. The quadtree is balanced.
std::vector<glm::dvec3> quadtreeTexels(const Discretization& discretization, const Grid& grid,
                                       const std::vector<glm::dvec3>& radiosity, int magnification);

}  // namespace hemitex::radiosity
